"""Protocols of seconds, and what a recorded hand needs to take part in them."""

TECHNIQUE = """
[[technique]]
name = "soft"
kind = "spring"
stiffness_n_per_m = 60
[[technique]]
name = "ratio"
kind = "gain"
gain_of_mass = [[15, 0.95], [200, 0.6], [800, 0.2]]
[[technique]]
name = "slow"
kind = "speed_limit"
limit_m_s_of_mass = [[15, 0.5], [200, 0.15], [800, 0.05]]
"""

ASKED = """
[[screens.questionnaire]]
name = "borg_cr10"
after = "fours"
"""

PAIRS = """
[[block]]
kind = "sorting"
name = "pairs"
masses_g = [15, 800]
trials = { soft = 1 }
max_run = 0
orders = "random"
"""

FOURS = """
[[block]]
kind = "sorting"
name = "fours"
masses_g = [15, 100, 300, 800]
trials = { C1 = 1, ratio = 1 }
max_run = 0
orders = "random"
"""

COMPARISON = """
[[block]]
kind = "comparison"
name = "{name}"
technique = "{technique}"
catch_fraction = 0
positive_answer = "any_choice"
interleave = "random"
"""

UP_DOWN = COMPARISON.format(name="adaptive", technique="soft") + """
[[block.staircase]]
name = "200g"
reference_g = 200
start = 600
step = 300
halve_every = 1
floor = 0
ceiling = 1500
change_step = "before_move"
stop_reversals = 3
stop_trials = 2
discard_reversals = 1
"""

CONSTANT = COMPARISON.format(name="constant", technique="slow") + """
[[block.staircase]]
name = "100g"
reference_g = 100
kind = "constant"
levels = [100, 400]
n_per_level = 1
order = "shuffled"
"""

QUEST = COMPARISON.format(name="quest", technique="soft") + """
[[block.staircase]]
name = "quest 100g"
reference_g = 100
kind = "quest"
guess = 200
guess_sd = 100
beta = 0.02
grain = 1
floor = 0
stop_trials = 1
"""

QUEST_PLUS = COMPARISON.format(name="quest+", technique="soft") + """
[[block.staircase]]
name = "quest+ 100g"
reference_g = 100
kind = "quest_plus"
function = "weibull"
levels = [100, 400]
threshold = { from = 50, to = 500, n = 5, spacing = "log" }
slope = 3
guess = 0.02
lapse = [0.02, 0.1]
stop_trials = 1
"""

PSI = COMPARISON.format(name="psi", technique="soft") + """
[[block.staircase]]
name = "psi 100g"
reference_g = 100
kind = "psi"
function = "indecision"
levels = [100, 400]
sensitivity = [0.01, 0.02]
indecision = { from = 0, to = 2, step = 1 }
bias = 0
lapse = 0.02
nuisance = ["indecision"]
stop_trials = 1
"""


def protocol(*blocks, display_rate_hz=15, contact=True):
    return (f'title = "Combinations"\ndisplay_rate_hz = {display_rate_hz}\n'
            f'require_contact = {str(contact).lower()}\n' + TECHNIQUE + "".join(blocks))


# One trial, two, and one of everything with every technique: three sorting trials, then seven
# comparisons, with a questionnaire between the two.
ONE = protocol(PAIRS, contact=False)
TWO = protocol(PAIRS, FOURS, contact=False)
ALL = protocol(ASKED, PAIRS, FOURS, UP_DOWN, CONSTANT, QUEST, QUEST_PLUS, PSI,
               contact=False)
N_SORTING, N_ALL = 3, 10


def write_recording(folder, n_trials):
    """A still hand beside the cubes, and an answer to each of the first trials of ALL."""
    folder.mkdir()
    rows = "".join(f"{t},0,-0.1,0.025,1,0,0,0\n" for t in (0, 10))
    actions = "trial_number,t_s,action,slot,label\n"
    for number in range(1, n_trials + 1):
        (folder / f"trial_{number}.csv").write_text("t_s,x_m,y_m,z_m,qw,qx,qy,qz\n" + rows)
        answer = "dont_know" if number <= N_SORTING else "no_difference"
        actions += f"{number},1.5,{answer},,\n"
    (folder / "actions.csv").write_text(actions)

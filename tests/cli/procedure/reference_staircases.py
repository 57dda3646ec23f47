"""Staircases as documented by other programs, implemented here to compare with `heft procedure`.

Each reference has `level` (to present next), `answer(positive)`, `finished`, `reversals` (levels
presented on reversal trials), and `keys()`: the same rule as keys of a procedure file.
"""


class PsychoPy:
    """StairHandler: one signed run counter; the step changes before the reversal's own move; the
    level is clamped after each move; ends when both nReversals and nTrials are reached."""

    def __init__(self, start, step_sizes, n_up, n_down, step_type, initial_rule, n_reversals,
                 n_trials, low, high):
        self.level, self.step_sizes, self.n_up, self.n_down = start, step_sizes, n_up, n_down
        self.start, self.step_type, self.initial_rule = start, step_type, initial_rule
        self.n_reversals, self.n_trials, self.low, self.high = n_reversals, n_trials, low, high
        self.run, self.direction, self.n = 0, None, 0
        self.reversals, self.finished = [], False

    def answer(self, positive):
        self.n += 1
        if positive:
            self.run = self.run + 1 if self.run > 0 else 1
        else:
            self.run = self.run - 1 if self.run < 0 else -1
        initially = self.initial_rule and not self.reversals
        if initially or self.run >= self.n_down or self.run <= -self.n_up:
            new_direction = "down" if positive else "up"
            if self.direction is not None and new_direction != self.direction:
                self.reversals.append(self.level)
            self.direction = new_direction
            self._move(self.step_sizes[min(len(self.reversals), len(self.step_sizes) - 1)])
            self.run = 0
        self.finished = len(self.reversals) >= self.n_reversals and self.n >= self.n_trials

    def _move(self, step):
        factor = {"lin": None, "db": 10.0 ** (step / 20.0), "log": 10.0 ** step}[self.step_type]
        if self.direction == "up":
            self.level = self.level + step if factor is None else self.level * factor
            if self.high is not None:
                self.level = min(self.level, self.high)
        else:
            self.level = self.level - step if factor is None else self.level / factor
            if self.low is not None:
                self.level = max(self.level, self.low)

    def keys(self):
        return dict(start=self.start, steps=self.step_sizes, up=self.n_up, down=self.n_down,
                    step_scale={"lin": "linear", "db": "db", "log": "log10"}[self.step_type],
                    initial_1up1down=self.initial_rule, stop_reversals=self.n_reversals,
                    min_trials=self.n_trials, stop_trials=100000, floor=self.low,
                    ceiling=self.high)


class Expyfun:
    """TrackerUD, limits ignored as reversals: two counters, own lists of steps up and down that
    change at given numbers of reversals or trials; ends when reversals or trials are reached."""

    def __init__(self, up, down, steps_up, steps_down, change_indices, stop_reversals, stop_trials,
                 start, low, high, change_rule="reversals"):
        self.change_rule = change_rule
        self.up, self.down, self.steps_up, self.steps_down = up, down, steps_up, steps_down
        self.change_indices, self.stop_reversals = change_indices, stop_reversals
        self.stop_trials, self.start, self.low, self.high = stop_trials, start, low, high
        self.level, self.finished, self.n = start, False, 0
        self.n_wrong = self.n_right = self.direction = 0
        self.reversals = []

    def answer(self, positive):
        self.n += 1
        step_direction = 0
        if positive:
            self.n_wrong, self.n_right = 0, self.n_right + 1
            if self.n_right == self.down:
                self.n_right, step_direction = 0, -1
        else:
            self.n_wrong, self.n_right = self.n_wrong + 1, 0
            if self.n_wrong == self.up:
                self.n_wrong, step_direction = 0, 1
        if step_direction != 0:
            if self.direction * step_direction < 0:
                self.reversals.append(self.level)
            self.direction = step_direction
        self.finished = (len(self.reversals) >= self.stop_reversals or self.n >= self.stop_trials)
        n = self.n if self.change_rule == "trials" else len(self.reversals)
        index = sum(n >= change for change in self.change_indices)
        steps = self.steps_up if step_direction > 0 else self.steps_down
        self.level = min(max(self.level + step_direction * steps[index], self.low), self.high)

    def keys(self):
        if self.change_rule == "trials" and self.change_indices:
            return self.other_keys() | dict(steps=self.steps_down, steps_up=self.steps_up,
                                            change_after_trials=self.change_indices)
        per_reversal = range(self.change_indices[-1] + 1 if self.change_indices else 1)
        index = [sum(n >= change for change in self.change_indices) for n in per_reversal]
        return self.other_keys() | dict(steps=[self.steps_down[i] for i in index],
                                        steps_up=[self.steps_up[i] for i in index])

    def other_keys(self):
        return dict(start=self.start, up=self.up, down=self.down,
                    stop_reversals=self.stop_reversals, stop_trials=self.stop_trials,
                    floor=self.low, ceiling=self.high)


class Palamedes:
    """PAL_AMUD: 1-up-1-down until the first reversal; truncate "no" keeps an untruncated level
    inside. Its counters are not reset by an opposite answer alone, which makes no difference as
    long as `up` or `down` is 1."""

    def __init__(self, up, down, step_up, step_down, start, low, high, truncate, stop_reversals):
        self.up, self.down, self.step_up, self.step_down = up, down, step_up, step_down
        self.start, self.low, self.high = start, low, high
        self.truncate, self.stop_reversals = truncate, stop_reversals
        self.inner, self.counts, self.direction = start, {True: 0, False: 0}, None
        self.reversals, self.finished = [], False

    @property
    def level(self):
        return min(max(self.inner, self.low), self.high)

    def answer(self, positive):
        self.counts[positive] += 1
        if not self.reversals or self.counts[positive] == (self.down if positive else self.up):
            self.counts = {True: 0, False: 0}
            if self.direction is not None and self.direction != positive:
                self.reversals.append(self.level)
            self.direction = positive
            self.inner += -self.step_down if positive else self.step_up
            if self.truncate:
                self.inner = self.level
        self.finished = len(self.reversals) == self.stop_reversals

    def keys(self):
        return dict(start=self.start, steps=[self.step_down], steps_up=[self.step_up], up=self.up,
                    down=self.down, initial_1up1down=True, floor=self.low, ceiling=self.high,
                    at_bound="clamp" if self.truncate else "virtual",
                    stop_reversals=self.stop_reversals, stop_trials=100000)


class Pychoacoustics:
    """Transformed and weighted up-down: the step is looked up before the turn point is counted.
    The track counts as going down at first, so it is compared from a positive start on."""

    def __init__(self, start, step_1, step_2, initial_turnpoints, percent, n_right, n_wrong,
                 total_turnpoints):
        self.level = self.start = start
        self.steps, self.percent = (step_1, step_2), percent
        self.initial_turnpoints = initial_turnpoints
        self.n_right, self.n_wrong, self.total_turnpoints = n_right, n_wrong, total_turnpoints
        self.run, self.last, self.direction = 0, None, "down"
        self.reversals, self.finished = [], False

    def _step_up(self, step_down):
        return step_down * (self.percent / (100 - self.percent))

    def answer(self, positive):
        step_down = self.steps[len(self.reversals) >= self.initial_turnpoints]
        self.run = self.run + 1 if positive == self.last else 1
        self.last = positive
        if self.run == (self.n_right if positive else self.n_wrong):
            self.run = 0
            if self.direction != ("down" if positive else "up"):
                self.reversals.append(self.level)
            self.direction = "down" if positive else "up"
            self.level += -step_down if positive else self._step_up(step_down)
        self.finished = len(self.reversals) == self.total_turnpoints

    def keys(self):
        steps = [self.steps[0]] * self.initial_turnpoints + [self.steps[1]]
        return dict(start=self.start, steps=steps, steps_up=[self._step_up(s) for s in steps],
                    up=self.n_wrong, down=self.n_right, change_step="after_move",
                    stop_reversals=self.total_turnpoints, stop_trials=100000)


class UnityToolkit:
    """Staircase Procedure toolkit for Unity: a counter of steps between 0 and n_steps that may go
    on beyond them (strict limits off); two quick starts with steps of their own."""

    def __init__(self, start_step, n_steps, strict, phases, until, stop_amount):
        self.counter = self.start_step = start_step
        self.n_steps, self.strict, self.stop_amount = n_steps, strict, stop_amount
        self.phases, self.until = phases, until  # (down, up) steps; reversals that end a phase
        self.going_up, self.first = None, True
        self.reversals, self.finished = [], False

    @property
    def level(self):
        return min(max(self.counter, 0), self.n_steps)

    def answer(self, positive):
        if not self.first and self.going_up == positive:
            self.reversals.append(self.level)
        self.first, self.going_up = False, not positive
        phase = sum(len(self.reversals) >= limit for limit in self.until)
        self.counter += -self.phases[phase][0] if positive else self.phases[phase][1]
        if self.strict:
            self.counter = self.level
        self.finished = len(self.reversals) == self.stop_amount

    def keys(self):
        phase = [sum(n >= limit for limit in self.until) for n in range(self.until[-1] + 1)]
        return dict(start=self.start_step, steps=[self.phases[p][0] for p in phase],
                    steps_up=[self.phases[p][1] for p in phase], floor=0, ceiling=self.n_steps,
                    at_bound="clamp" if self.strict else "virtual",
                    stop_reversals=self.stop_amount, stop_trials=100000)


class Paper:
    """The paper's rule (section 4.2.1): 1-up-1-down, the step halves every two reversals, ten
    reversals, held at 0; `after_move` is the other reading of its sentence about the step."""

    def __init__(self, start, step, after_move=False):
        self.level, self.start, self.step, self.after_move = start, start, step, after_move
        self.last, self.reversals, self.finished = None, [], False

    def answer(self, positive):
        before = len(self.reversals)
        if self.last is not None and positive != self.last:
            self.reversals.append(self.level)
        self.last = positive
        counted = before if self.after_move else len(self.reversals)
        self.level = max(0, self.level + (-1 if positive else 1) * self.step / 2 ** (counted // 2))
        self.finished = len(self.reversals) == 10

    def keys(self):
        return dict(start=self.start, step=self.step, halve_every=2, floor=0, stop_trials=100000,
                    change_step="after_move" if self.after_move else "before_move")

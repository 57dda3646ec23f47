"""Runs `heft procedure` over procedure files and input lines made up by tests."""
import json
import subprocess
import tempfile

program = "heft"  # path, set by the test's main


def command(*arguments):
    return [program, "procedure", *arguments]


def toml(staircases, **keys):
    def line(key, value):
        return f"{key} = {json.dumps(value)}\n"
    text = "".join(line(*item) for item in keys.items())
    for staircase in staircases:
        text += "[[staircase]]\n"
        text += "".join(line(k, v) for k, v in staircase.items() if v is not None)
    return text


def heft(procedure, lines, *options):
    """Runs a procedure (TOML) over input bytes. -> exit code, events, stderr"""
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(procedure)
        file.flush()
        run = subprocess.run(command(file.name, *options), input=lines, capture_output=True, timeout=60)
    events = [json.loads(line) for line in run.stdout.decode("utf-8").splitlines()]
    return run.returncode, events, run.stderr.decode("utf-8")


def answers_to_lines(answers):
    return "".join(json.dumps({"response": a}) + "\n" for a in answers).encode()


def mean(values):
    total = 0.0
    for value in values:
        total += value
    return total / len(values)


def only(events, kind):
    return [event for event in events if event["event"] == kind]

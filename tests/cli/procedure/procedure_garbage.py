"""Input lines that `heft procedure` must survive, and what the contract says of each."""
import json

SEEDS = [b'{"response":true}', b'{"response":false}', b'{"void":true}',
         b'{"answer":"comparison"}', b'{"answer":"none","level":3}',
         b'{"response":true,"level":124.5}', b'{ "level" : -1e3, "response" : false }']
EXTREMES = [b"[" * 4000, b'{"response":' * 300, b"[" * 200000, b"{" * 5000000,
            b'{"response":true,"level":' + b"9" * 400 + b"}",
            b'{"response":true,"level":' + b"9" * 300 + b"}",
            b'{"response":true,"level":1e400}', b'{"response":true,"level":-1e-400}',
            b'{"response":true,"level":NaN}', b'{"response":true,"level":Infinity}',
            b'{"response":true,"level":null}', b'{"response":true,"level":"3"}',
            b'{"response":true}\0', b"\0", b"\xff\xfe", b'{"\xc3\x28":true}', b"null", b"true",
            b'"', b"{}", b"[]", b'{"response":true}{"response":true}', b'{"response":1}',
            b'{"answer":"None"}', b'{"answer":true}', b'{"answer":1}', b'{"response":"none"}',
            b'{"answer":"none","answer":"none"}', b'{"answer":"none","response":false}',
            b'{"answer":"none","void":true}', b'{"answer":["none"]}',
            b'{"answer":"reference","level":-2}', b'{"\\u0061nswer":"non\\u0065"}',
            b'{"response":true,"response":true}', b'{"response":true,"void":true}',
            b'{"void":false}', b'{"void":true,"level":1}', b'{"level":1}', b'{"Response":true}',
            b'{"\\u0072esponse":true}', b'{"\\ud800":true}', b'{"response":[[[]]]}',
            b'{"response":{"response":true}}', b"\xef\xbb\xbf" + b'{"response":true}',
            b'{"' + b"k" * 4000 + b'":true}', b'{"response":true}' + b" " * 4096]


def mutated(rng):
    line = bytearray(rng.choice(SEEDS))
    for _ in range(rng.randint(0, 4)):
        at = rng.randrange(len(line) + 1)
        kind = rng.randrange(4)
        if kind == 0:
            line[at:at + rng.randint(1, 3)] = b""
        elif kind == 1:
            line[at:at] = bytes([rng.choice(b'{}[]",:.0123456789eE+-truefalsn \t\\')])
        elif kind == 2:
            line[at:at + 1] = bytes([rng.randrange(256)])
        else:
            other = rng.choice(SEEDS)
            line[at:at] = other[rng.randrange(len(other)):]
    return bytes(line).replace(b"\n", b"")


def understood(line):
    """What the contract says of an input line: "answer", "void" or "error"."""
    def once(pairs):
        if len(dict(pairs)) < len(pairs):
            raise ValueError("a key twice")
        return dict(pairs)

    def refuse(constant):
        raise ValueError(constant)
    try:
        if len(line) > 4096 or b"\0" in line:
            raise ValueError("too long or NUL")
        said = json.loads(line.decode("utf-8-sig"), object_pairs_hook=once, parse_constant=refuse)
        if said == {"void": True} and said["void"] is True:
            return "void"
        if not isinstance(said, dict):
            raise ValueError("no object")
        if "answer" in said:
            if said.pop("answer") not in ("comparison", "reference", "none"):
                raise ValueError("no choice")
        elif not isinstance(said.pop("response"), bool):
            raise ValueError("no answer")
        level = said.pop("level", 0)
        if said or type(level) not in (int, float) or not abs(float(level)) <= 1e300:
            raise ValueError("something else")
        return "answer"
    except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
        return "error"

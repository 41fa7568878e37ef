"""Arbitrary messages of any type: a valid message with some members replaced (strategies of hypothesis)."""
import copy

import genpy
from hypothesis import strategies

UNSIGNED = {"uint8": 8, "uint16": 16, "uint32": 32, "uint64": 64, "byte": 8, "char": 8}
SIGNED = {"int8": 8, "int16": 16, "int32": 32, "int64": 64}
NAMES = ("", "odom", "base_link", "camera_optical_frame", "map", "/odom", "plumb_bob", "bgr8", "mono8", "mono16", "8UC0", "florp")


def member(kind):
    """Values that a member of this type may have; None for a compound type."""
    if kind in UNSIGNED:
        return strategies.integers(0, 2 ** UNSIGNED[kind] - 1)
    if kind in SIGNED:
        return strategies.integers(-2 ** (SIGNED[kind] - 1), 2 ** (SIGNED[kind] - 1) - 1)
    if kind in ("float32", "float64"):
        return strategies.floats(width=int(kind[5:]))
    if kind == "bool":
        return strategies.booleans()
    if kind == "string":
        return strategies.one_of(strategies.sampled_from(NAMES), strategies.text("abc/_ \t0", max_size=40))
    if kind == "time":
        return strategies.builds(genpy.Time, strategies.integers(0, 2 ** 32 - 1), strategies.integers(0, 999999999))
    return None


def values(kind):
    """Values for members that are no lists, and for lists of them, of fixed or any length."""
    base, _, length = kind.partition("[")
    one = member(base)
    if one is None or not length:
        return one
    if base == "uint8":
        return strategies.binary(max_size=5000)
    fixed = length.rstrip("]")
    size = int(fixed) if fixed else None
    return strategies.lists(one, min_size=size or 0, max_size=size if size is not None else 12)


def leaves(message, owner=()):
    """[(path, values)] of every member of the message that can be replaced."""
    found = []
    for name, kind in zip(message.__slots__, message._slot_types):
        part, strategy = getattr(message, name), values(kind)
        if strategy is not None:
            found.append(((*owner, name), strategy))
        elif hasattr(part, "_slot_types"):
            found += leaves(part, (*owner, name))
        else:
            found += [leaf for i, item in enumerate(part) for leaf in leaves(item, (*owner, name, i))]
    return found


def part_of(owner, name):
    return owner[name] if isinstance(name, int) else getattr(owner, name)


def like(sound):
    """Messages like this one, with up to six members replaced."""
    places = leaves(sound)

    @strategies.composite
    def build(draw):
        message = copy.deepcopy(sound)
        for path, strategy in draw(strategies.lists(strategies.sampled_from(places), max_size=6)):
            owner = message
            for name in path[:-1]:
                owner = part_of(owner, name)
            setattr(owner, path[-1], draw(strategy))
        return message
    return build()

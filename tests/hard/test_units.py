"""Hard cases of the units: lengths, stresses and times scaled by 2^40 and 2^-40,
which are 1.1e12 and 9.1e-13, scale every result without any rounding, and by 1e12
and 1e-12 to rounding."""

from hard_case import check, check_below, compute

PROBES = ("mouth", "inside", "tip", "body")
KIND = {"t": "time", "u_1": "length", "u_2": "length", "opening": "length"}


def scaled(length=1., stress=1., time=1.):
    """The scene in other units. Periods are powers of two as well."""
    period = repr(512 * time)
    places = "; ".join(f"{name}: {x * length!r}, {y * length!r}"
                       for name, x, y in (("mouth", 1, 0), ("inside", 0.75, 0),
                                          ("tip", 0.5, 0), ("body", 0.25, 0.5)))
    return compute("units", [
        f"Geometry/Width={length!r}", f"Geometry/Height={length!r}",
        f"Geometry/Crack length={length / 2!r}", f"Output/Probes={places}",
        f"Boundary/Gap={-1e-5 * length!r}",
        f"Material/Young modulus={13000 * stress!r}",
        f"Material/Relaxation time={64 * time!r}", f"Loads/Period={period}",
        f"Loads/Traction=0; {10 * stress!r}*(sin(2*pi*(t/{period})) - 0.1)"])


def difference(base, other, **scales):
    """The largest of all columns, relative to the column's own size."""
    worst = 0.
    for probe in PROBES:
        mine, theirs = (results.table(f"probe_{probe}.csv")
                        for results in (base, other))
        for name, values in mine.items():
            scale = scales.get(KIND.get(name, "stress"), 1.)
            size = max(map(abs, values)) or 1.
            worst = max(worst, max(
                abs(b / scale - a) for a, b in
                zip(values, theirs[name], strict=True)) / size)
    return worst


base = scaled()
closed = base.table("contact.csv")["closed_nodes"]
check(0 in closed and max(closed) > 0, "the lip opens and closes")
for exponent in (40, -40):
    for scales in ({"length": 2.**exponent}, {"stress": 2.**exponent},
                   {"time": 2.**exponent}):
        check_below(difference(base, scaled(**scales), **scales), 0.,
                    f"units, {scales}: difference")
for factor in (1e12, 1e-12):
    scales = dict.fromkeys(("length", "stress", "time"), factor)
    check_below(difference(base, scaled(**scales), **scales), 1e-9,
                f"units, {scales}: difference")

"""Random bodies that are hot in one place and cold in another: relaxation times over
0 to 12 decades, of which a third of the bodies has more than two within the period."""

import random

from periodic_scenes import COMMON, PERIOD, steps, traction


def scene(seed):
    """Settings of a body: of ten, five have a chain, E(theta) or a gap, and half have a
    lip that opens and closes."""
    draw = random.Random(seed)
    decades = draw.uniform(0., 12.)
    varying = (min(1., draw.uniform(2.2, 5.) / max(decades, 1e-9))
               if seed % 3 == 0 and decades > 2.2 else 0.)
    lag = draw.choice([0., draw.uniform(0., 0.5)])
    shape = draw.choice([1, 2, 4])
    hot = f"(x^{shape}*(1 - 0.3*y))"
    cycle = f"0.5*(1 - cos(2*pi*(t/{PERIOD} - {lag:.4f}*y)))"
    fastest = PERIOD * 10**draw.uniform(-1.5, 1.)
    tau = (f"{fastest:.6g}*10^({decades:.4f}*(1 - {hot}*({1 - varying:.4f} + "
           f"{varying:.4f}*{cycle})))")
    if seed % 2 == 0:  # switches
        mean = draw.uniform(-3., 3.)
    else:
        mean = draw.choice([-1, 1]) * draw.uniform(12., 20.)
    second = draw.uniform(0., 0.5)
    settings = COMMON + steps(40) + [
        "Geometry/Subdivisions=10, 6", "Time integration/Scheme=sdirk2",
        traction(f"0; 10*(sin(2*pi*t/{PERIOD} + {draw.uniform(0., 6.3):.4f})"
                 f" + {second:.4f}*cos(4*pi*t/{PERIOD})) + {mean:.4f}")]
    if draw.random() < 0.5:
        settings += ["Material/Thermal expansion=1e-5", "Loads/Temperature="
                     f"{draw.choice([10, 30, 100])}*{hot}*{cycle}"]
    kind = seed % 10
    if kind in (1, 2):
        other = fastest * 10**draw.uniform(-1., 2.)
        settings += ["Material/Viscosity=chain",
                     f"Material/Chain={draw.uniform(0.3, 0.7):.3f}: {tau}; "
                     f"{draw.uniform(0.1, 0.3):.3f}: {other:.6g}"
                     if kind == 1 else
                     f"Material/Chain=0.6: {tau}; 0.4: {other:.6g}"]
    else:
        settings.append(f"Material/Relaxation time={tau}")
    if kind in (3, 4):
        settings += [f"Material/Young modulus=13000*(1 - 0.3*{hot}*{cycle})"]
    if kind == 5:
        settings += [f"Boundary/Gap=-{10**draw.uniform(-4.5, -3.):.3e}"]
    return settings

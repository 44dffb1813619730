"""Random bodies that are hot in one place and cold in another: relaxation times over
0 to 12 decades, of which a third of the bodies has more than two within the period."""

import random

from cracked import BOTTOM, CRACK, TOP, square
from periodic_scenes import COMMON, PERIOD, PROBES, steps, traction

MESH = ["Geometry/Subdivisions=6, 4"]
OPEN = ["Geometry/Shape=rectangle", "Output/Probes=top: 0.25, 1; body: 0.3, 0.6"]
WARM = ["Material/Thermal expansion=1e-5",
        "Loads/Temperature=30*(1 - cos(2*pi*t/600))*x^2"]
LOAD = [traction("0; 10*sin(2*pi*t/600) - 2")]


def relaxation(decades, varying=0., hot=30.):
    """Relaxation times that grow from right to left, and of the given part of the
    decades also within the period."""
    place = f"(1 - x^2*({1 - varying} + {varying}*0.5*(1 - cos(2*pi*t/600))))"
    return [f"Material/Relaxation time={hot}*10^({decades}*{place})"]


IN_SPACE = (9, 29, 49, 69)


def box_scene(load):
    return ["Dimension=3", "Geometry/Thickness=0.5", "Geometry/Subdivisions=6, 4, 2",
            "Boundary/Symmetry=2, 5, 6", "Boundary/Fixed points=automatic",
            "Output/Probes=mouth: 1, 0, 0; top: 0.25, 1, 0; body: 0.3, 0.6, 0.2",
            traction(f"0; {load}; 0")]


def shape_of(seed, load):
    """The body and its load: of ten, one has a crack with two lips and one is a
    cylinder; four are boxes."""
    if seed % 10 == 6:
        mesh = square("square.msh", 10)
        return ["Geometry/Shape=mesh file", f"Geometry/Mesh file={mesh}",
                f"Boundary/Crack={CRACK}", f"Boundary/Loaded={BOTTOM}, {TOP}",
                "Boundary/Fixed points=0.5, 0; 0, 0: 2", traction(f"0; ({load})*y")]
    if seed % 10 == 7:
        return ["Geometry/Subdivisions=10, 6", "Material/Plane state=axisymmetric",
                "Boundary/Symmetry=1, 2", "Boundary/Fixed points=none",
                traction(f"0; {load}")]
    if seed in IN_SPACE:
        return box_scene(load)
    return ["Geometry/Subdivisions=10, 6", traction(f"0; {load}")]


def probes_of(seed):
    return ("mouth", "top", "body") if seed in IN_SPACE else PROBES


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
        "Time integration/Scheme=sdirk2",
        *shape_of(seed, f"10*(sin(2*pi*t/{PERIOD} + {draw.uniform(0., 6.3):.4f})"
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

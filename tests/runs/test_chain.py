"""Maxwell bodies in parallel: the stress relaxes as the sum of exponentials
that the chain names; one body is the plain Maxwell body; a spring beside them
bears the mean load, so that nothing flows."""

import math

from crevasse_run import check, check_below, probe_difference, run

# Cooled at once and for ever between two rigid planes: a strain step.
HELD = """
subsection Geometry
  set Shape        = rectangle
  set Subdivisions = 2, 2
end
subsection Boundary
  set Symmetry = 2, 3
end
subsection Material
  set Young modulus     = 13000
  set Poisson ratio     = 0.2
  set Viscosity         = chain
  set Thermal expansion = 1e-5
end
subsection Loads
  set Period      = 600
  set Temperature = -100
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = top: 0.5, 1
  set Fields = none
end
"""

STRESS = 13000 * 1e-3  # E times the strain of the step


def recursion(chain, scheme, steps):
    """Stress of the scheme: a branch is multiplied by the stability polynomial
    at each step."""
    spring = 1 - sum(fraction for fraction, _ in chain)
    factors = []
    for _, tau in chain:
        z = -600 / steps / tau
        factors.append({"euler": 1 + z, "heun": 1 + z + z**2 / 2,
                        "rk4": 1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24}[scheme])
    return [STRESS * (spring + sum(branch[0] * factor**k for branch, factor
                                   in zip(chain, factors)))
            for k in range(2 * steps + 1)]


def prony(chain, t):
    spring = 1 - sum(fraction for fraction, _ in chain)
    return STRESS * (spring + sum(fraction * math.exp(-t / tau)
                                  for fraction, tau in chain))


CHAINS = {"two and a spring": [(0.5, 40.), (0.3, 300.)],
          "three": [(0.5, 30.), (0.3, 100.), (0.2, 1000.)],
          "one and a spring": [(0.25, 50.)]}


def test_relaxation():
    for name, chain in CHAINS.items():
        text = "; ".join(f"{fraction}: {tau}" for fraction, tau in chain)
        for scheme, order in (("euler", 1), ("heun", 2), ("rk4", 4)):
            errors = []
            for steps in (40, 80, 160):
                table = run(HELD, "relaxation", [
                    f"Material/Chain={text}",
                    f"Time integration/Scheme={scheme}",
                    f"Time integration/Steps per period={steps}"]
                    ).table("probe_top.csv")
                expected = recursion(chain, scheme, steps)
                check_below(max(abs(a - b) for a, b in
                                zip(table["s_22"], expected, strict=True))
                            / STRESS, 1e-12,
                            f"{name}, {scheme}, {steps} steps: recursion")
                errors.append(max(abs(s - prony(chain, t)) for t, s in
                                  zip(table["t"], table["s_22"])) / STRESS)
            orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
            print(f"{name}, {scheme}: errors against the sum {errors}, "
                  f"orders {orders}")
            check(abs(orders[-1] - order) < 0.25, f"{scheme}: order {order}")

    # In plane strain, and with the relaxation time as a formula.
    for setting in ("Material/Plane state=plane strain",
                    "Material/Chain=0.5: 40; 0.3: if(x < 0.5, 300, 150 + 150)"):
        table = run(HELD, "otherwise", ["Material/Chain=0.5: 40; 0.3: 300",
                                        "Boundary/Symmetry=0, 1, 2, 3",
                                        setting]).table("probe_top.csv")
        # Both directions are held: E/(1 - nu) in the plane of stress, and
        # E/(1 - 2 nu) where the third one is held as well.
        factor = 1 / 0.6 if "strain" in setting else 1 / 0.8
        expected = recursion(CHAINS["two and a spring"], "heun", 40)
        for column in ("s_11", "s_22"):
            check_below(max(abs(a - factor * b) for a, b in
                            zip(table[column], expected, strict=True)) / STRESS,
                        1e-12, f"{setting}: {column}")


CRACK = """
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 6, 4
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
end
subsection Loads
  set Period = 600
end
subsection Periodic state
  set Maximum periods = 3
  set Tolerance       = 0
end
subsection Output
  set Probes = mouth: 1, 0; inside: 0.3, 0.6
  set Fields = none
end
"""


def test_one_branch():
    """A chain of one body, or of several alike, is the Maxwell body; unsplit
    and with the mean load's flow split off."""
    for split in ("off", "on"):
        for mean in (-3, 3):
            here = [f"Periodic state/Secular split={split}",
                    f"Loads/Traction=0; 10*sin(2*pi*t/600) + {mean}"]
            plain = run(CRACK, "plain", here + ["Material/Relaxation time=60"])
            for text in ("1: 60", "0.25: 60; 0.75: 60"):
                chain = run(CRACK, "chain", here + [
                    "Material/Viscosity=chain", f"Material/Chain={text}"])
                check(chain.summary["secular"]["on"] == (split == "on"),
                      "the split form")
                check_below(probe_difference(plain, chain), 1e-11,
                            f"chain {text}, split {split}, mean {mean}")
                rates = [results.summary["secular"]["largest_rate"]
                         for results in (plain, chain)]
                check_below(abs(rates[1] / rates[0] - 1), 1e-11,
                            f"chain {text}, split {split}: largest rate")
            other = run(CRACK, "chain", here + [
                "Material/Viscosity=chain", "Material/Chain=1: 61"])
            check(probe_difference(plain, other) > 1e-4,
                  "the relaxation time counts")


def test_flow_of_a_chain():
    """Without a spring the chain flows with the sum of its viscosities:
    beta = mean F / (sum w tau) u_el."""
    taus = 0.5 * 40 + 0.3 * 60 + 0.2 * 100
    load = "Loads/Traction=0; 10*sin(2*pi*t/600) + 15"
    chain = ["Material/Viscosity=chain",
             "Material/Chain=0.5: 40; 0.3: 60; 0.2: 100"]
    elastic = run(CRACK, "elastic", ["Material/Viscosity=none",
                                     "Loads/Traction=0; 15"])
    expected = elastic.table("probe_mouth.csv")["u_2"][-1] / taus
    for split in ("on", "off"):
        beta = run(CRACK, "flowing", [
            load, f"Periodic state/Secular split={split}",
            "Periodic state/Maximum periods=20"] + chain
            ).summary["secular"]["per_probe"]["mouth"]["beta"][1]
        print(f"split {split}: beta {beta:.12g}, expected {expected:.12g}")
        check_below(abs(beta / expected - 1), 1e-10,
                    f"split {split}: flow of a chain")


def test_spring():
    """A spring stops the flow: the gain of a period falls to nothing, and the
    displacement is that of the spring under the mean load and more."""
    settings = ["Loads/Traction=0; 10*sin(2*pi*t/600) + 15",
                "Material/Viscosity=chain", "Material/Chain=0.5: 40; 0.3: 100",
                # The stress is periodic at once, long before the displacement.
                "Periodic state/Maximum periods=30"]
    results = run(CRACK, "spring", settings)
    summary = results.summary
    secular = summary["secular"]
    print("secular flow:", secular["why"])
    check(not secular["on"] and "spring" in secular["why"], secular["why"])
    opening = summary["extremes"]["opening"]
    check_below((secular["largest_rate"] or 0.) * 600 / opening, 1e-10,
                "gain in a period")
    # Always open and homogeneous: u = u_el (mean / (1 - sum w) + what
    # alternates), whose mean over a period is that of the spring alone.
    elastic = run(CRACK, "elastic", ["Material/Viscosity=none",
                                     "Loads/Traction=0; 15"])
    expected = elastic.table("probe_mouth.csv")["u_2"][-1] / 0.2
    table = results.table("probe_mouth.csv")
    mean = sum(table["u_2"][-41:-1]) / 40
    check_below(abs(mean / expected - 1), 1e-10, "mean displacement")
    check(min(table["opening"][-41:]) > 0, "always open")


if __name__ == "__main__":
    test_relaxation()
    test_one_branch()
    test_flow_of_a_chain()
    test_spring()

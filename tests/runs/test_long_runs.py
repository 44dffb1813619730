"""A thousand periods of the paper's example with every scheme: the stress of the
last is that of the 20th, but for the accuracy of the scheme. There is no drift."""

from crevasse_run import SOURCE, check, check_below, run

SCENE = SOURCE / "prm/raous1980.prm"
PERIODS = 1000
SCHEMES = {"euler": [], "heun": [], "rk4": [], "predictor corrector": [],
           "exponential": [], "sdirk2": [],
           "rk4 with events": ["Locate contact events=true"],
           "sdirk2 adaptive": ["Step control=adaptive",
                               "Relative tolerance=1e-2"],
           "arkode explicit": [], "arkode implicit": [],
           "arkode explicit adaptive": ["Step control=adaptive",
                                        "Relative tolerance=1e-3",
                                        "Locate contact events=true"]}


def period_of(probe, number):
    """s_22 at the samples of a period."""
    first, last = 600 * (number - 1) - 1e-6, 600 * number - 1e-6
    return [s for t, s in zip(probe["t"], probe["s_22"]) if first <= t < last]


# Under a mean load periodic states are reached fast, and stay (one scheme of each
# kind). Under none the approach falls like 1 / n squared until no sample touches
# the lip (model, section 2): schemes that are not there after 20 periods move on
# within their accuracy.
for load, schemes, bounds in (
        ("10*(sin(2*pi*t/600) - 0.1)",
         ("heun", "exponential", "rk4 with events", "arkode implicit"), {}),
        ("10*sin(2*pi*t/600)", SCHEMES,
         {"euler": 4e-3, "exponential": 2e-2, "sdirk2 adaptive": 3e-2})):
    for name in schemes:
        results = run(SCENE, "long", [
            f"Loads/Traction=0; {load}", "Output/Fields=none",
            "Contact/Solver=condensed active set",
            f"Periodic state/Maximum periods={PERIODS}",
            "Periodic state/Tolerance=0",
            f"Time integration/Scheme={name.split(' with')[0].split(' adap')[0]}",
            *(f"Time integration/{setting}" for setting in SCHEMES[name])])
        probe = results.table("probe_C.csv")
        early, late = (period_of(probe, number) for number in (20, PERIODS))
        check(len(early) == len(late), f"{name}: samples repeat")
        difference = max(abs(a - b) for a, b in zip(early, late))
        check_below(difference / max(map(abs, late)), bounds.get(name, 1e-9),
                    f"{load}, {name}: period 20 against period {PERIODS}")
        check_below(results.summary["stress_change"][-1], 1e-10,
                    f"{load}, {name}: change of the last period")
        certificate = results.summary["certificate"]
        check_below(max(certificate[key] for key in
                        ("penetration", "tension", "complementarity", "residual")),
                    certificate["accuracy"], f"{load}, {name}: certificate")

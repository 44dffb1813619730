"""Units: names that label the log, the summary and the report, and change no number."""

import contextlib
import io

from crevasse_run import SOURCE, check, check_close, execute, overrides, run
from crevasse import report

BODY = SOURCE / "prm" / "raous1980_body.prm"
SETTINGS = ["Discretisation/Singular functions=2", "Contact/Solver=automatic",
            "Periodic state/Method=march", "Periodic state/Maximum periods=2",
            "Periodic state/Tolerance=0", "Output/Probes=C: 1, 0",
            "Crack tip/Stress intensity=true"]


def test_units():
    plain = run(BODY, "plain", SETTINGS)
    named = run(BODY, "named", [*SETTINGS, "Units=mm, MPa, h, K"])
    for table in ("crack_tip.csv", "probe_C.csv"):
        check((plain.directory / table).read_text()
              == (named.directory / table).read_text(), "nothing is converted")
    check("units" not in plain.summary, "no units without Units")
    factor = named.summary["units"]["K_in_MPa_sqrt_m"]
    check_close(factor, 1e-3 ** 0.5, 1e-12, "MPa sqrt(mm) in MPa sqrt(m)")
    log = (named.directory / "log.txt").read_text()
    largest = named.summary["crack_tip"]["K_I"]["largest"]
    check(f"to {largest:.5g} MPa sqrt(mm) (" in log
          and f" to {factor * largest:.4g} MPa sqrt(m))" in log, "K in both units")
    with contextlib.redirect_stdout(io.StringIO()):
        check(report.main([str(named.directory)]) == 0
              and report.main([str(plain.directory)]) == 0, "reports")
    page, words = ((results.directory / "report.html").read_text()
                   for results in (named, plain))
    check(f"MPa × √mm; {factor * largest:.4g} MPa √m" in page and "u (mm)" in page
          and "(mm)" not in words and "u (length)" in words, "units in the report")


def test_doubts():
    """Sizes that no solid has are warned of; names that are none are refused."""
    for units, modulus, words in (
            ("m, Pa, s, K", 200, "the Young modulus reaches 200 Pa"),
            ("m, GPa, s, K", 13000, "the Young modulus reaches 1.3e+04 GPa"),
            ("mm, N/mm^2, a, °C", 200, ""), ("µm, kg/mm2, d, degF", 200, ""),
            ("mm, MPa, a, K", 200, "")):
        log = execute("--check", BODY, *overrides([
            f"Units={units}", f"Material/Young modulus={modulus}"]))[1]
        check((words in log and "Is it in these units?" in log) if words
              else "Is it in these units?" not in log, f"{units}: {log}")
    for units, words in (("mm, MPa", "must be units of length, stress, time and "
                          "temperature"),
                         ("mm, MPa, fortnight, K", "\"fortnight\" is no unit of time; "
                          "known are s, min, h, d, a")):
        status, _, error = execute("--check", BODY, *overrides([f"Units={units}"]))
        check(status == 2 and words in error, error)


if __name__ == "__main__":
    test_units()
    test_doubts()

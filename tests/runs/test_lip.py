"""The state of the lip against closed forms: uniform compression presses the
whole lip alike, to its very tip, which a support holds; an open crack is free
of pressure; where a curved gap is closed, nothing is left open between nodes."""

from crevasse_run import check, check_close, run

SCENE = """\
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 8, 4
end
subsection Material
  set Young modulus = 13000
  set Poisson ratio = 0.2
  set Viscosity     = none
end
subsection Loads
  set Period   = 1
  set Traction = 0; -10
end
subsection Time integration
  set Steps per period = 1
end
subsection Output
  set Probes = tip: 0.5, 0; next: 0.53, 0; middle: 0.8, 0; mouth: 1, 0; ahead: 0.49, 0
end
"""

ON_LIP = ("tip", "next", "middle", "mouth")

for a, settings in (
        (0.5, []), (0.5, ["Discretisation/Degree=2"]),
        (0.5, ["Geometry/Refinements=2"]),
        (0.47, ["Geometry/Crack length=0.47",
                "Output/Probes=tip: 0.53, 0; next: 0.55, 0; middle: 0.8, 0; "
                "mouth: 1, 0; ahead: 0.52, 0"])):
    results = run(SCENE, "pressed", settings)
    contact = results.table("contact.csv")
    check(len(contact["t"]) == 2, "one step")
    check_close(contact["force"][0], 10 * a, 1e-10, f"{settings}: force")
    check_close(contact["largest_pressure"][0], 10, 1e-9,
                f"{settings}: largest pressure")
    check(contact["closed_nodes"][0] == results.summary["contact_nodes"],
          "the tip is no contact node")
    for name in ON_LIP:
        probe = results.table(f"probe_{name}.csv")
        check_close(probe["pressure"][0], 10, 1e-9, f"pressure at {name}")
        check_close(probe["opening"][0], 0, 1e-15, f"opening at {name}")
        check_close(probe["s_22"][0], -10, 1e-9, f"stress at {name}")
    check("pressure" not in results.table("probe_ahead.csv"),
          "the ligament is no lip")

    opened = run(SCENE, "opened", settings + ["Loads/Traction=0; 10"])
    contact = opened.table("contact.csv")
    check(contact["closed_nodes"][0] == 0, "the crack is open")
    resting = run(SCENE, "resting", settings + ["Loads/Traction=0; 0"])
    check(resting.table("contact.csv")["closed_nodes"][0] == 0, "a lip at rest is open")
    check_close(contact["force"][0], 0, 1e-10, "force on an open crack")
    for name in ON_LIP:
        probe = opened.table(f"probe_{name}.csv")
        check_close(probe["pressure"][0], 0, 1e-10, f"pressure at {name}")
        check((probe["opening"][0] > 0) == (name != "tip"), f"{name} opens")

# A gap of 1e-5 (x - 1/2)^2 is not linear between the nodes of Q1 elements, the
# displacement that closes it is.
closed = run(SCENE, "curved", ["Boundary/Gap=-1e-5*(x-0.5)^2",
                               "Output/Probes=between: 0.8, 0"])
probe = closed.table("probe_between.csv")
check(closed.table("contact.csv")["closed_nodes"][0] == 4, "all is closed")
check_close(probe["opening"][0], 0, 1e-15, "opening between closed nodes")
check(probe["u_2"][0] < -8e-7, "the lip has moved down")

"""The field view of reports: what is packed into a page is what the program wrote,
bodies are seen whole and without inner faces, and a browser shows them."""

import json
import os
import pathlib
import re
import sys

# Numbers of NumPy 1.24 keep their type beside those of Python, as in NumPy 2.
os.environ["NPY_PROMOTION_STATE"] = "weak"
import numpy  # noqa: E402

from browser import open_host
from crevasse_run import SOURCE, check, check_below, run

sys.path.insert(0, str(SOURCE / "source" / "python"))
from crevasse import field_figures, field_view, report as make_report  # noqa: E402
from crevasse.fields import Fields  # noqa: E402
from crevasse.run_reader import Run  # noqa: E402
from crevasse.skin import OUTLINE, mixed  # noqa: E402

PAPER = SOURCE / "prm" / "raous1980.prm"
# Looks at each page, and uses it as a reader would.
HOST = """<!DOCTYPE html><pre id="found">nothing</pre>
<script>
function picture(page) {
  const canvas = page.document.getElementById("field-canvas");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  return [...new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer)];
}

async function look(frame) {
  const page = frame.contentWindow, part = (name) => page.document.getElementById("field-" + name);
  const view = await page.eval("fieldView"), pictures = {};
  const trouble = part("trouble").hidden ? "" : part("trouble").textContent;
  if (!view) return {page: frame.name, trouble, hidden: !part("view").offsetParent};
  const change = async (name, value, event) => {
    part(name).value = value;
    part(name).dispatchEvent(new page.Event(event));
    await view.ready;
    return pictures[name] = picture(page);
  };
  const first = picture(page);
  const counts = new Map();
  for (const pixel of first) counts.set(pixel, (counts.get(pixel) || 0) + 1);
  const colours = [...counts.values()].filter((count) => count > 100).length;
  await change("component", "stress_22", "change");
  const values = await Promise.all(view.data.times.map((_, k) => view.data.values("stress_22", k)));
  const time = part("time").textContent;
  await change("instant", view.data.first === 0 ? 1 : 0, "input");
  const moved = part("time").textContent !== time;
  await change("factor", 30, "input");
  part("cells").click();
  pictures.cells = picture(page);
  const order = [first, ...["component", "instant", "factor", "cells"].map((name) => pictures[name])];
  const box = part("canvas").getBoundingClientRect();
  part("canvas").dispatchEvent(new page.PointerEvent("pointermove", {
    clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 }));
  return {page: frame.name, trouble, colours, moved, values: values.map((v) => [...v]),
          quads: [...view.data.quads],
          changed: order.slice(1).map((after, k) => after.some((pixel, i) => pixel !== order[k][i])),
          bar: part("bar").getAttribute("aria-label"), value: part("value").textContent,
          overflow: page.document.documentElement.scrollWidth - frame.width,
          menu: [...part("component").options].map((option) => option.value)};
}
addEventListener("load", async () => {
  const found = [];
  for (const frame of document.querySelectorAll("iframe")) found.push(await look(frame));
  document.getElementById("found").textContent = JSON.stringify(found);
});
</script>
"""
PLANE = ["Contact/Solver=automatic", "Geometry/Subdivisions=8, 4",
         "Output/Field times=0, 150, 450, 520", "Refinement/Strategy=tip",
         "Refinement/Cycles=2"]
SPACE = ["Geometry/Subdivisions=4, 2, 3", "Periodic state/Maximum periods=1",
         "Refinement/Strategy=tip", "Refinement/Cycles=1"]


def skin_of(results):
    """The skin as it is packed, and the fields on it."""
    run_ = Run(results.directory)
    skin, fields = field_view.read(run_, [file for _, file in run_.instants()])
    moves = numpy.stack([fields[f"displacement_{k + 1}"]
                         for k in range(run_.dimension)], -1)
    used, marks = skin.finish(moves)
    return skin, marks, {name: values[:, used] for name, values in fields.items()}


def on_border(points, low, high):
    """For each row of points, on how many sides of the box all of them lie."""
    slack = 1e-6 * (high - low).max()
    return ((abs(points - low) < slack).all(axis=1).sum(axis=1)
            + (abs(points - high) < slack).all(axis=1).sum(axis=1))


def seen_whole(results):
    """Nothing inside is drawn, although cells of different sizes meet there."""
    skin, marks, fields = skin_of(results)
    low, high = skin.points.min(axis=0), skin.points.max(axis=0)
    ends = skin.points[numpy.stack([skin.quads, numpy.roll(skin.quads, -1, 1)], 2)]
    drawn = ends[marks[:, None] // OUTLINE >> numpy.arange(4) & 1 == 1]
    sides = on_border(drawn, low, high)
    length = numpy.linalg.norm(drawn[:, 1] - drawn[:, 0], axis=1).sum()
    size = high - low
    if len(size) == 2:
        check((sides >= 1).all(), "the outline is within the body")
        check_below(abs(length - 2 * size.sum()), 1e-5, "length of the outline")
        return fields
    check((sides == 2).all(), "edges that are not sharp are drawn")
    check_below(abs(length - 8 * size.sum()), 1e-5, "length of the edges, twice")
    faces = skin.points[skin.quads]
    check((on_border(faces, low, high) == 1).all(), "faces within the body are drawn")
    a, b, c, d = numpy.moveaxis(faces, 1, 0)
    area = numpy.linalg.norm(numpy.cross(c - a, d - b), axis=1).sum() / 2
    check_below(abs(area - 2 * (size[0] * size[1] + size[1] * size[2]
                                + size[2] * size[0])), 1e-5, "area of the surface")
    return fields


def report(results):
    check(make_report.main([str(results.directory)]) == 0, "report")
    return results.directory / "report.html"


def frames(pages):
    return HOST + "\n".join(
        f'<iframe name="{name}" width="{width}" height="900" '
        f'src="{page.resolve().as_uri()}"></iframe>'
        for name, page in pages.items() for width in (400, 1200))


def shown(runs):
    pages = {name: report(results) for name, results in runs.items()}
    fields = {name: seen_whole(results) for name, results in runs.items()}
    quads = {name: skin_of(results)[0].quads for name, results in runs.items()}
    found, console = open_host(frames(pages))
    check(not console, f"the browser complains: {console}")
    for frame in found:
        expected = fields[frame["page"]]["stress_22"]
        range_ = numpy.ptp(expected)
        check(frame.pop("quads") == quads[frame["page"]].ravel().tolist(),
              "quadrilaterals of the page")
        check_below(abs(numpy.array(frame.pop("values")) - expected).max() / range_,
                    1e-5, "error of the stress in the page, of its range")
        print(frame)
        check(frame["colours"] > 4 and frame["moved"] and all(frame["changed"])
              and len(frame["changed"]) == 4, f"the picture: {frame}")
        check(frame["overflow"] <= 0 and not frame["trouble"], f"{frame}")
        check(re.fullmatch(r"stress s₂₂: colours from \S+ to \S+ in steps of \S+",
                           frame["bar"]) and " at (" in frame["value"], f"{frame}")
        check({"von_mises_stress", "stress_22", "displacement_2", "viscous_strain_11"}
              <= set(frame["menu"]), f"{frame}")
    check("stress_13" in found[-1]["menu"] and "stress_33" not in found[0]["menu"],
          "components")
    return pages


def without_webgl(pages):
    found, _ = open_host(frames(pages), "--disable-3d-apis")
    for frame in found:
        check("no WebGL" in frame["trouble"] and frame["hidden"], f"{frame}")


def many_instants(results):
    """Of which a page has some, and says so."""
    most = field_figures.MOST_FILES
    field_figures.MOST_FILES = 3
    text = report(results).read_text()
    field_figures.MOST_FILES = most
    packed = json.loads(re.search(r'id="field-data">(.*?)</script>', text, re.S)[1])
    check("Figure 4" in text, "figures of the paper")
    check(packed["times"] == [1200., 1650., 1800.] and "3 of 5 stored instants" in text,
          f"{packed['times']}")
    packed = field_view.pack(Run(results.directory))
    levels = {component["name"]: component["levels"] for component in packed["components"]}
    steps = numpy.diff(levels["stress_22"])
    check(numpy.ptp(steps) < 1e-9 * steps[0] and len(steps) > 6, f"levels: {levels}")
    most = field_view.MOST_CHARACTERS
    field_view.MOST_CHARACTERS = 1
    check(len(field_view.pack(Run(results.directory))["times"]) == 2, "not thinned")
    field_view.MOST_CHARACTERS = most


def numbers_of_edges():
    """Edges, told apart by numbers of their ends, of a cube's many alike ones."""
    ends = mixed(numpy.indices((8, 8, 8)).reshape(3, -1).T)
    edges = numpy.stack(numpy.meshgrid(ends, ends), -1).reshape(-1, 2)
    check(len(numpy.unique(mixed(edges))) == len(edges), "edges share a number")


def materials():
    """Their border is not drawn as one of the body; names are not the paper's."""
    mesh = (SOURCE / "tests/meshes/edge_crack_2.msh").read_text()
    for number in (9, 10, 11, 12):  # of another surface, too
        mesh = mesh.replace(f"\n{number} 3 2 10 1 ", f"\n{number} 3 2 20 2 ")
    pathlib.Path("two_materials.msh").write_text(mesh)
    results = run(PAPER, "materials", [
        "Contact/Solver=automatic", "Title=", "Geometry/Shape=mesh file",
        "Geometry/Mesh file=two_materials.msh", "Geometry/Refinements=1",
        "Boundary/Symmetry=1", "Boundary/Contact=2", "Boundary/Loaded=3",
        "Boundary/Fixed points=0.5, 0: 1",
        "Material/Young modulus=if(material == 10, 13000, 40000)"])
    x = skin_of(results)[0].points[:, 0]
    material = seen_whole(results)["material"][0]
    check((material[x < 0.49] == 10).all() and (material[x > 0.51] == 20).all()
          and {10, 20} == set(material[abs(x - 0.5) < 0.01]), "materials")
    text = report(results).read_text()
    check(all(words in text for words in ("Stress at t = 1350", "no boundary ids",
                                          "<figcaption>Mesh</figcaption>"))
          and "Figure 4" not in text, "titles of another scene")
    named = Run(results.directory)  # 10 has a name in the mesh file
    component, = (component for component in field_view.pack(named)["components"]
                  if component["name"] == "material")
    legend = field_figures.mesh(named, Fields(named.instants()[0][1])).axes[0].get_legend()
    for names, other in ((component["names"], "20"),
                         ([text.get_text() for text in legend.get_texts()],
                          "material 20")):
        check(names[:2] == ["body", other], f"names of materials: {names}")


plane = run(PAPER, "plane", PLANE)
space = run(SOURCE / "prm" / "cracked_box.prm", "space", SPACE, status=3)
without_webgl(shown({"plane": plane, "space": space}))
many_instants(plane)
materials()
numbers_of_edges()
pathlib.Path("host.html").unlink()

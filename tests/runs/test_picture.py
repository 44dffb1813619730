"""crevasse --check --picture: the page has all names and roles with the counts and
sizes of the mesh, nothing else is written or replaced, and a browser shows it."""

import base64
import collections
import html
import json
import math
import os
import pathlib
import re
import zlib

import meshio

from browser import open_host
from crevasse_run import SOURCE, check, check_close, execute, execute_on, full, overrides

PRM = SOURCE / "prm"
BOX = ["Geometry/Subdivisions=4, 2, 3"]
UNREFINED = ["Geometry/Refinements=0", "Refinement/Strategy=none"]
# Looks at each page, and uses its legend and buttons as a reader would.
HOST = """<!DOCTYPE html><pre id="found">nothing</pre>
<script>
// The body, seen from above and from below.
function picture(page, view) {
  const canvas = page.document.getElementById("field-canvas");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d", { willReadFrequently: true });
  return [1, 2].map(() => {
    const { object, target } = view.scene.controls;
    object.position.y = 2 * target.y - object.position.y;
    view.scene.controls.update();
    context.drawImage(canvas, 0, 0);
    return new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer).join() +
      page.document.getElementById("mesh-marks").innerHTML;
  }).join();
}

async function look(frame) {
  const page = frame.contentWindow, all = (what) => [...page.document.querySelectorAll(what)];
  await page.eval("meshMarks");
  const view = await page.eval("fieldView");
  const texts = all("#mesh-marks text").map((text) => text.textContent);
  const unchanged = [];
  for (const use of all("input[data-marks], button[data-place], #field-cells")) {
    const before = picture(page, view);
    use.click();
    if (picture(page, view) === before) unchanged.push(use.outerHTML);
  }
  const menu = page.document.getElementById("field-component");
  menu.value = "quality";
  menu.dispatchEvent(new page.Event("change"));
  await view.ready;
  return {page: frame.name, texts, unchanged, quads: [...view.data.corners],
          quality: [...view.shown.values],
          legend: all("input[data-marks]").map((box) => box.parentElement.textContent.trim()),
          overflow: page.document.documentElement.scrollWidth - frame.width,
          bar: page.document.getElementById("field-bar").getAttribute("aria-label")};
}
addEventListener("load", async () => {
  const found = [];
  for (const frame of document.querySelectorAll("iframe")) found.push(await look(frame));
  document.getElementById("found").textContent = JSON.stringify(found);
});
</script>
"""

Row = collections.namedtuple("Row", "id role n size low high")


def picture(scene, name, settings=(), status=0):
    """The page of a scene, and what the program said."""
    page = pathlib.Path(name + ".html")
    code, output, error = execute("--check", scene, "--picture", page,
                                  *overrides(settings))
    check(code == status, f"{name}: exit status {code}\n{output}{error}")
    return page, output + error


def numbers(text):
    return [float(number.replace("\N{MINUS SIGN}", "-"))
            for number in re.findall("[\N{MINUS SIGN}\\d.]+", text)]


def rows(page, heading):
    """The rows of a table of the page, by names; of unnamed ones by numbers."""
    part = page.read_text().split(f'<h2 id="{heading}">')[1].split("</table>")[0]
    for row in part.split("<tr")[2:]:
        yield [html.unescape(re.sub("<.*?>", "", cell)).strip()
               for cell in re.split("</t[dh]>", row.split(">", 1)[1])][:-1]


def boundaries(page):
    found = {}
    for _, name, number, role, n, *rest in rows(page, "boundaries"):
        size, low, high = map(numbers, rest) if len(rest) == 3 else ([0], [], [])
        found[name or number] = Row(int(number), role, int(n), size[0], low, high)
    return found


def packed(page):
    return json.loads(re.search(r'id="field-data">(.*?)</script>', page.read_text(),
                                re.S)[1])


def lengths(page):
    """How many numbers the parts of each boundary have."""
    return [len(zlib.decompress(base64.b64decode(group["parts"]))) // 4
            for group in packed(page)["groups"]]


def plate():
    """A built-in shape: the sides of a square with an edge crack."""
    page, _ = picture(PRM / "raous1980.prm", "plate",
                      ["Geometry/Subdivisions=8, 4", "Output/Probes=mouth: 1, 0"])
    found = boundaries(page)
    expected = {"left": Row(0, "free", 4, 1., [0, 0], [0, 1]),
                "right": Row(1, "free", 4, 1., [1, 0], [1, 1]),
                "ligament": Row(2, "symmetry", 4, .5, [0, 0], [.5, 0]),
                "top": Row(3, "loaded", 8, 1., [0, 1], [1, 1]),
                "lip": Row(4, "contact", 4, .5, [.5, 0], [1, 0])}
    check(found == expected, f"{found}")
    check(lengths(page) == [8, 8, 8, 16, 8], f"lines: {lengths(page)}")
    fields = packed(page)
    check(fields["fixed"] == [{"point": [.5, 0.], "components": [True, False],
                               "held": ["u₁"]}]
          and fields["probes"] == [{"name": "mouth", "point": [1., 0.]}]
          and fields["front"] == [[[.5, 0.], [.5, 0.]]] and not fields["worst"],
          "points")
    check("All cells have right angles" in page.read_text()
          and "32 cells, " in page.read_text(), "cells")
    return page


def box():
    page, _ = picture(PRM / "cracked_box.prm", "box", BOX)
    found = boundaries(page)
    counts = {name: (row.role, row.n, row.size) for name, row in found.items()}
    check(counts == {"left": ("free", 6, .5), "right": ("free", 6, .5),
                     "ligament": ("symmetry", 6, .25), "lip": ("contact", 6, .25),
                     "top": ("loaded", 12, .5), "front": ("free", 8, 1.),
                     "back": ("free", 8, 1.)}, f"{counts}")
    check(found["lip"][4:] == ([.5, 0, 0], [1, 0, .5]), f"{found['lip']}")
    check(lengths(page) == [6, 6, 6, 12, 6, 8, 8], f"faces: {lengths(page)}")
    material, = rows(page, "materials")
    check(material[1:4] == ["0", "24", "0.5"], f"{material}")
    front = packed(page)["front"]
    check(sorted(end[2] for edge in front for end in edge)
          == [0, 1 / 6, 1 / 6, 1 / 3, 1 / 3, .5]
          and all(end[:2] == [.5, 0] for edge in front for end in edge), f"{front}")
    return page


def lips():
    """Names of a Gmsh file: as many faces as its elements, of a crack two each."""
    page, output = picture(PRM / "inclined_crack.prm", "lips", UNREFINED)
    mesh = meshio.read(PRM / "inclined_crack.msh")
    names = {number: name for name, (number, dim) in mesh.field_data.items()
             if dim == 1}
    counts, sizes = collections.Counter(), collections.Counter()
    for block, ids in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        for (a, b), number in zip(block.data, ids) if block.type == "line" else ():
            lip = 2 if names[number] == "crack" else 1
            counts[names[number]] += lip
            sizes[names[number]] += lip * math.dist(mesh.points[a], mesh.points[b])
    found = boundaries(page)
    roles = {name: row.role for name, row in found.items() if row.role != "free"}
    check(roles == {"bottom": "clamped", "top": "loaded", "crack": "crack"},
          f"{roles}")
    for name in names.values():
        check(found[name].n == counts[name], f"{name}: {found[name]} {counts[name]}")
        check_close(found[name].size, sizes[name], 1e-3 * sizes[name],
                    f"length of {name}")
    worst = packed(page)["worst"][0]
    quality, x, y = re.search(
        r"scaled Jacobian (\S+) .*in the cell around \((\S+), (\S+)\)", output).groups()
    check(f"{worst['quality']:.2f}" == quality
          and math.dist(worst["point"], (float(x), float(y))) < 1e-5,
          f"the worst cell: {worst}, {output}")
    check(len(packed(page)["front"]) == 2, "tips of the crack")
    return page


def oblique():
    """Cells of which all have an angle of 60 degrees: its sine is their quality."""
    for dimension, kind, side in ((2, 3, 1), (3, 5, 3)):
        corners = [(x + y * math.cos(math.pi / 3), y * math.sin(math.pi / 3), z)
                   for z in range(dimension - 1) for y in range(2) for x in range(3)]
        base = [[1, 2, 5, 4], [2, 3, 6, 5]]
        top = [[node + 6 for node in cell] for cell in base]
        cells = [a + b for a, b in zip(base, top)] if dimension == 3 else base
        bottoms = [cell[:2] + cell[5:3:-1] for cell in cells]
        elements = [(side, 1, nodes) for nodes in bottoms] + [
            (kind, 7, nodes) for nodes in cells]
        lines = [f"{k} {form} 2 {group} {group} " + " ".join(map(str, nodes))
                 for k, (form, group, nodes) in enumerate(elements, 1)]
        pathlib.Path("oblique.msh").write_text("\n".join([
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2",
            f'{dimension - 1} 1 "side <1>"\n{dimension} 7 "all"\n$EndPhysicalNames',
            f"$Nodes\n{len(corners)}", *(f"{k} {x} {y} {z}" for k, (x, y, z) in
                                         enumerate(corners, 1)),
            f"$EndNodes\n$Elements\n{len(lines)}", *lines, "$EndElements\n"]))
        pathlib.Path("oblique.prm").write_text(
            f"set Dimension = {dimension}\nsubsection Geometry\nset Shape = mesh file\n"
            "set Mesh file = oblique.msh\nend\nsubsection Boundary\n"
            "set Clamped = side <1>\nend\nsubsection Loads\nset Body force = "
            + "; ".join(dimension * "1") + "\nend\n")
        page, output = picture("oblique.prm", "oblique")
        found = boundaries(page)
        check((found["side <1>"].role, found["side <1>"].n) == ("clamped", 2)
              and found["0"].n == (4 if dimension == 2 else 8), f"{found}")
        check_close(found["side <1>"].size, 2, 1e-3, "size of the side")
        worst = packed(page)["worst"]
        check(len(worst) == 2, "two cells are oblique")
        for cell in worst:
            check_close(cell["quality"], math.sin(math.pi / 3), 1e-12, "quality")


def materials():
    page, output = picture(PRM / "coated_blade.prm", "materials")
    expected = re.search("  materials: (.*)", output)[1]
    found = ", ".join(f"{number} ({name}): {n} cells"
                      for name, number, n, *_ in rows(page, "materials"))
    check(found.replace("\N{NO-BREAK SPACE}", "") == expected,
          f"{found} instead of {expected}")
    check(packed(page)["components"][0]["names"] == ["blade", "coat"], "names")


def mistake():
    """A scene whose supports let the body move is drawn, with what is missing; names
    of the page are text."""
    page, output = picture(PRM / "raous1980.prm", "mistake", [
        "Boundary/Symmetry=none", "Boundary/Contact=none", "Boundary/Fixed points=none",
        "Title=<b> & </script>"], status=3)
    text = page.read_text()
    check("The scene has a mistake" in text and "picture: mistake.html" in output
          and "<h1>&lt;b&gt; &amp; &lt;/script&gt;</h1>" in text
          and boundaries(page)["lip"].role == "open crack", "the page of a mistake")
    sentence = output.split("crevasse: ")[-1].strip().splitlines()[0]
    check(html.escape(sentence[:60]) in text, f"{sentence}")
    check("Contact does not stop" not in output, "there is no contact")
    page, _ = picture(PRM / "raous1980.prm", "mistake", ["Boundary/Loaded=17"],
                      status=2)
    check("no face of the surface</td>" in page.read_text(), "an id without faces")
    page, _ = picture(PRM / "inclined_crack.prm", "mistake", [
        *UNREFINED, "Boundary/Crack=none", "Crack tip/Stress intensity=false"])
    check(boundaries(page)["crack"].role == "no role"
          and "it is no crack unless" in page.read_text(), "a group inside the body")
    # The scene's mistake comes first, and then that of the page.
    pathlib.Path("folder.html").mkdir(exist_ok=True)
    wrong = ["Boundary/Loaded=17"]
    for name, message in (("folder.html", "is not a page of --picture"),
                          ("none/new.html", "The picture none/new.html was not made")):
        status, _, error = execute("--check", PRM / "raous1980.prm", "--picture", name,
                                   *overrides(wrong))
        check(status == 2 and 0 <= error.find("[Boundary] Loaded") < error.find(message),
              f"{name}: {status}\n{error}")
    pathlib.Path("folder.html").rmdir()
    pathlib.Path("empty.msh").write_text("nothing")
    status, _, error = execute(
        "--check", PRM / "inclined_crack.prm", "--picture", "new.html", *overrides([
            f"Geometry/Mesh file={pathlib.Path('empty.msh').resolve()}",
            "Boundary/Clamped=1", "Boundary/Loaded=2", "Boundary/Crack=3"]))
    check(status == 2 and error.count("MeshFormat") == 1
          and error.endswith("The picture new.html was not made.\n"), error)


def refused():
    """Each with a sentence; nothing is written, and no other file replaced."""
    scene = PRM / "raous1980.prm"
    other = pathlib.Path("other.html")
    other.write_text("<p>mine")
    pipe = pathlib.Path("pipe.html")
    os.mkfifo(pipe)
    before = sorted(pathlib.Path().rglob("*"))
    for status, words, message in (
            (2, [scene, "--picture", "new.html"], "shows a scene before a run"),
            (2, ["--check", scene, "--picture", "new.png"],
             "must be a file name that ends in .html"),
            (2, ["--check", scene, "--picture", ""],
             "must be a file name that ends in .html"),
            (4, ["--check", scene, "--picture", other], "is not a page of --picture"),
            (4, ["--check", scene, "--picture", pipe], "is not a page of --picture"),
            (4, ["--check", scene, "--picture", "none/new.html"],
             "picture none/new.html was not made")):
        code, _, error = execute(*words)
        check(code == status and message in error, f"{words}: {code}\n{error}")
    code, _, error = execute_on(2, "--check", scene, "--picture", "new.html")
    check(code == 2 and "on one process" in error, f"two processes: {code}\n{error}")
    check(sorted(pathlib.Path().rglob("*")) == before and other.read_text() == "<p>mine",
          "written")
    code, output, _ = execute("--check", scene, "--picture", "plate.html", "--quiet")
    check(code == 0 and not output, "a page is replaced, quietly")
    check(sorted(pathlib.Path().rglob("*")) == before, "more than the page is written")


@full
def browser():
    pages = {"plate": plate(), "box": box(), "lips": lips()}
    found, console = open_host(HOST + "\n".join(
        f'<iframe name="{name}" width="{width}" height="900" '
        f'src="{page.resolve().as_uri()}"></iframe>'
        for name, page in pages.items() for width in (400, 1200)))
    check(not console, f"the browser complains: {console}")
    for frame in found:
        quads, quality = frame.pop("quads"), frame.pop("quality")
        print(frame)
        check(not frame["unchanged"] and frame["overflow"] <= 0
              and frame["bar"].startswith("cell quality: "), f"{frame}")
        check(len(quality) == len(quads) and max(quads) + 1 == len(set(quads))
              and 0 < min(quality) <= max(quality) < 1.001, f"cells of {frame['page']}")
    of_box, of_lips = found[2], found[4]
    check(len(found[0]["texts"]) == 3
          and {"u₁ = 0", "crack tip", "mouth"} == set(found[0]["texts"]), "marks")
    check("lip: contact" in of_box["legend"] and "crack front" in of_box["legend"]
          and "crack" in of_lips["legend"] and "top: loaded" in of_lips["legend"],
          "legends")
    check(sorted(text.split()[0] for text in of_lips["texts"])
          == ["crack", "crack", "quality"], f"marks: {of_lips['texts']}")
    pathlib.Path("host.html").unlink()


for stale in pathlib.Path().glob("*.html"):
    stale.unlink()
plate()
box()
lips()
oblique()
materials()
mistake()
refused()
browser()

"""Geometries (.geo, .brep) as Mesh file: meshed by Gmsh once for each content; .geo files
that would start programs, or read or write files, are refused."""

import pathlib
import shutil
import subprocess
import sys

from crevasse_run import SOURCE, check, execute, start

from crevasse.mesh_geo import check as check_geometry
from crevasse.mesh_parts import Mistake

TOUCH = "touch was_there"
SQUARE = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
"""
GROUPS = """Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Surface("square") = {1};
"""
# Each is refused at the line given.
HOSTILE = (
    (1, f'SystemCall "{TOUCH}";'), (1, f'NonBlockingSystemCall "{TOUCH}";'),
    (1, f'SystemCall\n/* a */ // b\n\n"{TOUCH}";'), (2, f'a = 1;\nSystemCall \'{TOUCH}\';'),
    (1, f'SystemCall = 1; SystemCall "{TOUCH}";'),
    (1, f'SystemCall = 1; SystemCall ("{TOUCH}");'),
    (1, f'SystemCall = 1; SystemCall(1) "{TOUCH}";'),
    (1, f'c = "{TOUCH}"; SystemCall = 1; SystemCall c;'),
    (1, 'SystemCall StrCat("touch", " was_there");'),
    (2, f'Macro SystemCall\nSystemCall "{TOUCH}";\nReturn\nCall SystemCall;'),
    (1, f'Macro("f", "SystemCall \'{TOUCH}\';"); Call f;'),
    (1, f'Function("f", "SystemCall \'{TOUCH}\';"); Call f;'),
    (2, f'If (0)\na = "EndIf SystemCall \'{TOUCH}\'; //";\nEndIf'),
    (2, f'If (0)\n// EndIf SystemCall "{TOUCH}";\nEndIf'),
    (1, f'If (1) SystemCall "{TOUCH}"; EndIf'),
    (1, f'If (0) Else SystemCall "{TOUCH}"; EndIf'),
    (1, f'For i In {{0:1}} SystemCall "{TOUCH}"; EndFor'),
    (1, f'a = "{"x" * 1100} \'; SystemCall \'{TOUCH}\'; ";'),
    (1, f'// a\rSystemCall "{TOUCH}";'), (1, f'a = "\0"; SystemCall "{TOUCH}"; b = "";'),
    (1, f';. SystemCall "{TOUCH}";'), (1, f'a[] = {{0 ... SystemCall "{TOUCH}"}};'),
    (1, f'Point(1) = {{0, 0, 0 SystemCall "{TOUCH}"}};'),
    (1, f'ExternalProcess = 1; Field[1] = ExternalProcess; Field[1].CommandLine = "{TOUCH}";'),
    (1, 'Field[1] = Structured; Field[1].FileName = "/etc/passwd";'),
    (1, f'OnelabRun("a", "{TOUCH}");'), (1, f'Solver.Executable0 = "{TOUCH}";'),
    (1, 'SetString("Solver.Executable0", "touch");'), (1, 'General.TextEditor = "touch";'),
    (1, 'DefineConstant[ a = {1, Name "a", OnelabAction "x"} ];'),
    (1, 'Include "other.geo";'), (1, 'Merge "other.msh";'), (1, 'Open "other.geo";'),
    (1, 'ShapeFromFile "other.brep";'), (1, 'v() = ShapeFromFile("other.brep");'),
    (1, 'a[] = ListFromFile["/etc/passwd"];'), (1, 'a = GetEnv("HOME");'),
    (1, 'Save "was_there.msh";'), (1, 'Print "was_there.msh";'),
    (1, 'Printf("a") > "was_there";'), (1, 'Printf("a") >> "was_there";'),
    (1, 'n = "was_there"; Printf("a") > n;'), (1, "Plugin(Crack).Run;"), (1, "Exit;"),
    (1, 'SetName "a";'), (1, "Delete Options;"), (1, "Background Mesh View[0];"),
    (1, "Mesh 2;"), (1, 'a = "b\nc";'), (1, 'a = "b'), (1, "/* a"), (2, "b = 1;\n/*/"))
HARMLESS = (
    "a = 1; b[] = {a, 2}; p~{1} = 3; Point(1) = {a, b[0], #b[], p~{1}};",
    "For i In {0:3}\n Point(newp) = {i, 0, 0};\nEndFor", "For (1:3)\nEndFor",
    "Macro Move\n x += 1;\nReturn\nx = 0; Call Move;",
    'DefineConstant[ L = {0.3, Name "Parameters/L", Min 0.1} ];', 'Printf("a = %g", 2);',
    "out[] = Extrude {0, 0, 1} { Surface{1}; Layers{5}; Recombine; };",
    "Field[1] = Distance; Field[1].NodesList = {1}; Background Field = 1;",
    "W = 1; If (W > 0 && !(W == 2)) H = W; Else H = 3; EndIf",
    "Transfinite Curve {1, 2} = 10 Using Progression 1.1; i = 1; i++; x = i > 2 ? 3 : 4;",
    "BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };",
    "// SystemCall, in a comment\n/* Merge */ s = \"Save\"; Mesh.ElementOrder = 2;")


def test_hostile():
    for line, text in HOSTILE:
        try:
            check_geometry(text, "file.geo")
        except Mistake as mistake:
            check(str(mistake).startswith(f"file.geo, line {line}: "), f"{text}: {mistake}")
            check(str(mistake).endswith("--trust-mesh"), f"{mistake}")
        else:
            check(False, f"not refused: {text}")
    for text in HARMLESS:
        check_geometry(text, "file.geo")
    for path in (SOURCE / "prm").glob("*.geo"):
        check_geometry(path.read_text(), path)


def test_programs_are_started_if_trusted():
    """The same file does what it says with --trust-mesh: the check is what prevents it.
    An option file beside a .geo file, which Gmsh runs, is not read."""
    here = pathlib.Path("was_there")
    here.unlink(missing_ok=True)
    pathlib.Path("hostile.geo").write_text(SQUARE + GROUPS + f'SystemCall "{TOUCH}";\n')
    status, _, error = start("mesh", "hostile.geo", "hostile.msh")
    check(status == 2 and "hostile.geo, line 6: \"SystemCall\" is not allowed" in error, error)
    pathlib.Path("plain.geo").write_text(SQUARE + GROUPS)
    pathlib.Path("plain.geo.opt").write_text(f'SystemCall "{TOUCH}";\n')
    status, output, error = start("mesh", "plain.geo", "plain.msh")
    check(status == 0 and "boundaries: bottom (1), top (2)" in output, output + error)
    check(not here.exists(), "a program was started")
    status, output, error = start("mesh", "--trust-mesh", "hostile.geo", "hostile.msh")
    check(status == 0 and here.exists(), output + error)


def scene(name, roles):
    path = pathlib.Path(name).with_suffix(".prm")
    path.write_text(f"""subsection Geometry
  set Shape     = mesh file
  set Mesh file = {name}
end
subsection Boundary
{roles}
end
subsection Material
  set Viscosity = none
end
subsection Loads
  set Period   = 1
  set Traction = 0; 1
end
""")
    return path


def test_runs():
    """Converted once for each content; as the mesh that Gmsh itself makes."""
    shutil.rmtree("results", ignore_errors=True)
    roles = "  set Clamped = bottom\n  set Loaded  = top"
    pathlib.Path("square.geo").write_text(SQUARE + GROUPS)
    for is_new in (True, False, True):
        status, output, error = execute("--check", scene("square.geo", roles))
        check(status == 0 and "clamped 1 (bottom); loaded 2 (top)" in output, output + error)
        check(("by Gmsh" in output) == is_new, output)
        if not is_new:
            pathlib.Path("square.geo").write_text(SQUARE + GROUPS + "MeshSize{:} = 0.5;\n")
    pathlib.Path("hostile.geo").write_text(SQUARE + GROUPS + "Exit;\n")
    status, _, error = execute("--check", scene("hostile.geo", roles))
    check(status == 2 and "line 6: \"Exit\" is not allowed" in error, error)
    pathlib.Path("other.geo").write_text(SQUARE)
    pathlib.Path("hostile.geo").write_text('Include "other.geo";\n' + GROUPS)
    path = scene("hostile.geo", roles)
    status, output, error = execute("--check", "--trust-mesh", path)
    check(status == 0 and "clamped 1 (bottom); loaded 2 (top)" in output, output + error)
    pathlib.Path("other.geo").write_text(SQUARE + "MeshSize{:} = 0.5;\n")
    status, changed, error = execute("--check", "--trust-mesh", path)
    check(status == 0 and changed != output, "an included file has changed: " + changed)


def test_brep():
    """Faces have names by their numbers."""
    pathlib.Path("shape.geo").write_text(SQUARE)
    subprocess.run([sys.executable, "-c", "import gmsh; gmsh.initialize(); "
                    "gmsh.open('shape.geo'); gmsh.write('shape.brep')"], check=True,
                   capture_output=True)
    status, output, error = execute("--check", scene(
        "shape.brep", "  set Clamped = curve 1\n  set Loaded  = 3"))
    check(status == 0 and "clamped 1 (curve 1); loaded 3 (curve 3)" in output, output + error)


def test_mistakes():
    for text, message in (("Point(1) = {0, 0", "syntax error"), ("", "it has no surface"),
                          (SQUARE.replace("1, 1}", "1, 0}"), "Gmsh cannot mesh it")):
        pathlib.Path("wrong.geo").write_text(text)
        status, _, error = start("mesh", "wrong.geo", "wrong.msh")
        check(status == 2 and message in error and "Traceback" not in error,
              f"exit status {status}: {error}")


test_hostile()
test_programs_are_started_if_trusted()
test_runs()
test_brep()
test_mistakes()

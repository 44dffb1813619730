# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Meshes geometries (.geo, .brep) by Gmsh. A .geo file is a program, which could start
others and write files: only statements that describe geometry and mesh are allowed."""

import multiprocessing
import pathlib
import re
import signal
import tempfile
import zlib

from crevasse.mesh_parts import Mistake

SUFFIXES = (".geo", ".brep")
TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|\"[^\"]*\"|'[^']*'|[A-Za-z_]\w*|"
                   r"\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|[-+*/]=|\+\+|--|"
                   r"[=!<>]=|\s+|.", re.S | re.A)
CONTROL = {"If", "ElseIf", "Else", "EndIf", "For", "EndFor", "Return", "Macro", "Function"}
ALLOWED = CONTROL | set("""
Abs Acos Affine Alternate AlternateLeft AlternateRight Asin Atan Atan2 Attractor
AttractorAnisoCurve BSpline Background Ball Bezier BooleanDifference BooleanFragments
BooleanIntersection BooleanUnion Boundary BoundaryLayer BoundingBox Box Bump Beta Call
CatmullRom Ceil CenterOfMass Chamfer Characteristic Choices Circle Closed Coherence
CombinedBoundary Compound Cone Constant Cos Cosh Curvature Curve Cylinder DefineConstant
DefineNumber Delete Dilate Disk Distance Duplicata Ellipse Ellipsis Elliptic Ellipsoid Exp
Extrude Fabs Field Fillet Floor Fmod Frustum Gradient Highlight Hole Hypot In
IntersectAniso Label Laplacian Layers Left Length Line LinSpace Log Log10 LogSpace Loop
Loops Max MathEval MathEvalAniso MaxEigenHessian Mean MeshSize MeshSizeFromBoundary Min
MinAniso Modulo Name Nurbs Knots Order Parametric Param Periodic Physical Pi Plane Point
Points PointsOf Printf Progression QuadTriAddVerts QuadTriNoNewVerts Rand Range ReadOnly
Rectangle Recombine Recursive Restrict Reverse ReverseMesh Right Rotate Round Ruled
SetFactory Sin Sinh Smoother Sphere Spline Split Sqrt Step Surface Symmetry Tan Tanh
ThickSolid Threshold ThruSections Torus Transfinite TransfQuadTri Translate Units Using
Visible Volume Wedge Wire newc newcl newf newl newll newp newreg news newsl newv
""".split())
OPTIONS = {"Mesh", "Geometry"}  # Mesh.ElementOrder = 2
ASSIGNS = {"=", "+=", "-=", "*=", "/=", "++", "--"}
OPENS, CLOSES = set("([{"), set(")]}")
LONGEST_TEXT = 500  # Gmsh takes the rest of a longer text for statements


def tokens_of(text, path):
    """Words, numbers, texts and signs of a .geo file, with their lines."""
    line, found = 1, []
    for match in TOKEN.finditer(text):
        token = match[0]

        def refuse(what):
            raise Mistake(f"{path}, line {line}: {what}. Change it, or allow all that Gmsh "
                          "can do by --trust-mesh")
        if re.search(r"[\0-\x08\x0b-\x1f\x7f]", token.replace("\r\n", "\n")):
            refuse("a control character is not allowed")
        if token in ("\"", "'") or text.startswith("/*", match.start()) and len(token) < 4:
            refuse("the text or comment that begins here has no end")
        is_text = token[0] in "\"'"
        if is_text and ("\n" in token or len(token) > LONGEST_TEXT):
            refuse("a text must be on one line and have at most "
                   f"{LONGEST_TEXT} characters")
        if is_text or token.startswith(("//", "/*")):
            # Where Gmsh skips statements it looks for such a word in all that is there.
            for word in CONTROL & {*re.findall(r"\w+", token)} - {"If", "For", "Function"}:
                refuse(f"the word {word} is not allowed in texts and comments")
        if is_text or not (token.isspace() or token.startswith(("//", "/*"))):
            found.append((token, line))
        line += token.count("\n")
    return found


def check(text, path):
    """Raises a Mistake at the first word that is neither known to be harmless nor a
    variable: a name that is assigned a value, as in "a = 1" or "points[] = {}"."""
    tokens = [*tokens_of(text, path), (";", 0)]
    words = [token for token, _ in tokens]
    named = [k for k, word in enumerate(words) if re.match(r"[A-Za-z_]", word)
             and word not in ALLOWED
             and not (words[k - 1] == "." and words[k - 2] in OPTIONS | {"]"})]
    variables = {words[k] for k in named if is_assigned(words, k)}

    def refuse(k, what):
        raise Mistake(f"{path}, line {tokens[k][1]}: {what}. Allowed are statements that "
                      "describe geometry and mesh, and can neither start programs nor read "
                      "or write files. Change it, or allow all that Gmsh can do by "
                      "--trust-mesh")
    for k in named:
        word, follows = words[k], words[k + 1]
        is_option = word in OPTIONS and follows == "."
        is_value = (word in variables and not re.match(r"[\w\"'.]", follows)
                    and (is_assigned(words, k) or not begins(words, k)))
        is_name = (words[k - 1] in ("Macro", "Function", "Call")
                   or words[k - 1:k + 2:2] == ["For", "In"])
        if not (is_option or is_value or is_name):
            refuse(k, f"\"{word}\" is not allowed")
    for k, word in enumerate(words):
        if word == "Printf" and ">" in words[k:words.index(";", k)]:
            refuse(k, "Printf to a file is not allowed")
        if word in ("Macro", "Function") and not re.match(r"[A-Za-z_]", words[k + 1]):
            refuse(k, f"{word} must be followed by a name")
        if word == "Field" and words[k + 1] in OPENS:
            end = end_of(words, k + 1)
            if words[end] == "=" and words[end + 1] not in ALLOWED:
                refuse(k, f"the field \"{words[end + 1]}\" is not allowed")


def begins(words, k):
    """Whether a word may begin a statement."""
    return (k == 0 or words[k - 1] in {";", "}", ")", "]"} | CONTROL
            or words[k - 2] in ("Macro", "Function"))


def end_of(words, k):
    """The place behind the brackets that open at k, if there are some: (1), [i], ~{i}."""
    while words[k] in OPENS or words[k] == "~":
        depth = 0
        while k + 1 < len(words):
            depth += (words[k] in OPENS) - (words[k] in CLOSES)
            k += 1
            if depth == 0:
                break
        if k + 1 == len(words):
            break
    return k


def is_assigned(words, k):
    """Whether a value is assigned to the word at k, or to an element of it."""
    return words[k - 1:k + 2:2] == ["For", "In"] or words[end_of(words, k + 1)] in ASSIGNS


def by_gmsh(work, source, trusted, *arguments, **options):
    """The result of work(gmsh, source, ...) in a process of its own, which Gmsh may end.
    A source that is not trusted is checked, and copied: Gmsh runs a file source.opt."""
    import gmsh  # pylint: disable=import-outside-toplevel

    content = pathlib.Path(source).read_bytes()
    if not trusted and str(source).lower().endswith(".geo"):
        check(content.decode("latin-1"), source)
    context = multiprocessing.get_context("fork")
    here, there = context.Pipe(duplex=False)

    def begin(path):
        try:
            gmsh.initialize(readConfigFiles=False)
            gmsh.option.setNumber("General.Terminal", 0)
            there.send((True, work(gmsh, path, *arguments, **options)))
        except Exception as error:  # pylint: disable=broad-except
            there.send((False, str(error).replace(path, str(source))))
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / pathlib.Path(source).name
        if not trusted:
            copy.write_bytes(content)
        child = context.Process(target=begin, args=(str(source if trusted else copy),))
        child.start()
        there.close()
        try:
            good, result = here.recv()
        except EOFError:
            good, result = False, "it ended unexpectedly"
        child.join()
    if child.exitcode and child.exitcode < 0:
        good, result = False, f"it ended by {signal.Signals(-child.exitcode).name}"
    if not good:
        raise Mistake(f"{source}: Gmsh cannot mesh it: {result.strip()}")
    return result


def crack_lengths(gmsh, source):
    """{full name: value} of the constants of a .geo file that are named "crack length",
    as by DefineConstant[ a = {1, Name "Crack length"} ]."""
    gmsh.open(source)
    return {name: gmsh.onelab.getNumber(name)[0] for name in gmsh.onelab.getNames()
            if name.rpartition("/")[2].lower() == "crack length"}


def mesh_in(folder, name, source, trusted, *arguments, **options):
    """Meshes a geometry; the name of the file has the checksum of its content."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder) as place:
        part = pathlib.Path(place) / "part.msh"
        by_gmsh(mesh, source, trusted, part, *arguments, **options)
        path = folder / f"{name}_{zlib.crc32(part.read_bytes()):08x}.msh"
        part.replace(path)
    return path


def mesh(gmsh, source, target, additions="", group=None, factor=1., constants=()):
    """Meshes a geometry, with the values of some of its constants {name: value}, with
    some statements more, whose curves join a group."""
    model = gmsh.model
    for name, value in dict(constants).items():
        gmsh.onelab.setNumber(name, [value])
    gmsh.open(source)
    if additions:
        before = {*model.getEntities(1)}
        with tempfile.NamedTemporaryFile("w", suffix=".geo") as file:
            file.write(additions)
            file.flush()
            gmsh.merge(file.name)
        curves = [*model.getEntitiesForPhysicalGroup(1, group)]
        name = model.getPhysicalName(1, group)
        model.removePhysicalGroups([(1, group)])
        model.addPhysicalGroup(1, curves + [tag for _, tag in model.getEntities(1)
                                            if (1, tag) not in before], group)
        model.setPhysicalName(1, group, name)
    dimension = model.getDimension()
    if dimension < 2:
        raise ValueError("it has no surface")
    name_all(model, dimension)
    gmsh.option.setNumber("Mesh.MeshSizeFactor",
                          factor * gmsh.option.getNumber("Mesh.MeshSizeFactor"))
    model.mesh.generate(dimension)
    gmsh.write(str(target))
    return [*report(model, dimension)]


def name_all(model, dimension):
    """Gives cells a group if there is none, and all faces one in files without any, such
    as .brep: curve 1, curve 2, ..."""
    nouns = ["", "curve", "surface", "volume"]
    for kind in {dimension, *([dimension - 1] if not model.getPhysicalGroups() else [])}:
        if not model.getPhysicalGroups(kind):
            for _, tag in model.getEntities(kind):
                model.addPhysicalGroup(kind, [tag], tag)
                model.setPhysicalName(kind, tag, f"{nouns[kind]} {tag}")


def report(model, dimension):
    nodes, _, _ = model.mesh.getNodes()
    kinds, elements, _ = model.mesh.getElements(dimension)
    yield f"  {len(nodes)} points"
    yield "  elements: " + ", ".join(
        f"{len(tags)} {model.mesh.getElementProperties(kind)[0]}"
        for kind, tags in zip(kinds, elements))
    for what, kind in (("materials", dimension), ("boundaries", dimension - 1)):
        names = [f"{model.getPhysicalName(kind, tag) or tag} ({tag})"
                 for _, tag in model.getPhysicalGroups(kind)]
        yield f"  {what}: " + (", ".join(names) or "none has a name")

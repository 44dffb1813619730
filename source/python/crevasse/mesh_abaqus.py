# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Reads meshes of Abaqus and CalculiX with their sets and surfaces: of these meshio 5.0
loses surfaces, generated nodes, sets of sets, and all of parts and instances."""

import collections
import itertools
import pathlib
import re

import numpy

from crevasse.mesh_parts import Mesh, Mistake

Block = collections.namedtuple("Block", "keyword, options, lines, place")
# Keywords that change the mesh, and are not implemented.
REFUSED = {"NCOPY", "NFILL", "NMAP", "ELCOPY", "ELGEN", "SYSTEM", "IMPORT"}
# Dimensions of element types, by the beginning of their names.
DIMENSIONS = (("A?C3D|DC3D|SC[68]|COH3D", 3), ("T[23]D|B[23]|R2D2|PIPE|[SMR]AX", 1),
              ("A?C[PAGE2]|DC|D?S[3-9]|STRI|[MR]3D|SFM3D", 2))


def read(path):
    deck = Deck()
    try:
        for block in blocks_of(pathlib.Path(path)):
            deck.take(block)
    except RecursionError:
        raise Mistake(f"{path}: a file includes itself") from None
    return deck.mesh()


def blocks_of(path):
    """Keywords with their options and lines of data, without comments, also those of
    included files."""
    block, is_continued = None, False
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("**"):
            continue
        if line.startswith("*") or is_continued:
            words = [word.strip() for word in line.lstrip("*").split(",")]
            if not is_continued:
                yield from included(path, block)
                block = Block(" ".join(words.pop(0).upper().split()), {}, [],
                              f"{path}, line {number}")
            for word in filter(None, words):
                option, _, value = word.partition("=")
                block.options[option.strip().upper()] = value.strip().strip('"')
            is_continued = line.endswith(",")
        elif block:
            block.lines.append([word.strip() for word in line.split(",")])
    yield from included(path, block)


def included(path, block):
    if block and block.keyword == "INCLUDE":
        yield from blocks_of(path.parent / block.options.get("INPUT", ""))
    elif block:
        yield block


class Scope:
    """Nodes, elements, sets and surfaces of an instance, or of the assembly: indices by
    label, and groups by their names in capital letters. A deck without parts has the
    assembly alone."""

    def __init__(self):
        self.nodes, self.elements = {}, {}
        self.nsets, self.elsets, self.surfaces = {}, {}, {}
        self.titles = {}  # names as the file writes them
        self.internal = set()  # names of sets that serve others


class Deck:
    """What has been read so far."""

    def __init__(self):
        self.points, self.elements = [], []  # elements: dimension, nodes
        self.assembly = self.scope = Scope()
        self.parts, self.instances = {}, {}
        self.part = None  # whose keywords are stored
        self.ignored = set()

    def take(self, block):
        """Reads a keyword, or stores it for the instances of its part."""
        try:
            self.process(block)
        except KeyError as error:
            raise Mistake(f"{block.place}: *{block.keyword}: there is no {error}") \
                from None
        except (ValueError, IndexError, TypeError, AttributeError) as error:
            raise Mistake(f"{block.place}: *{block.keyword} cannot be read: {error}") \
                from None

    def process(self, block):
        keyword = block.keyword
        if keyword == "END PART":
            self.part = None
        elif keyword == "PART":
            self.part = self.parts[block.options["NAME"].upper()] = []
        elif self.part is not None:
            self.part.append(block)
        elif keyword == "INSTANCE":
            self.place_instance(block)
        elif keyword == "END INSTANCE":
            self.scope = self.assembly
        elif keyword in REFUSED:
            raise ValueError("it is not implemented; write all nodes and elements")
        elif method := getattr(self, "read_" + keyword.lower(), None):
            method(block.options, block.lines)
        elif keyword not in ("HEADING", "ASSEMBLY", "END ASSEMBLY"):
            self.ignored.add("*" + keyword)

    def place_instance(self, block):
        """Reads the keywords of a part, then moves and turns its nodes."""
        self.scope = self.instances[block.options["NAME"].upper()] = Scope()
        first = len(self.points)
        for stored in self.parts[block.options["PART"].upper()]:
            self.take(stored)
        numbers = [[float(word or 0) for word in line] for line in block.lines]
        points = numpy.array(self.points[first:]).reshape(-1, 3)
        if numbers:
            points += (numbers[0] + [0., 0.])[:3]
        if len(numbers) > 1:
            begin, end, angle = (numpy.array(numbers[1][:3]),
                                 numpy.array(numbers[1][3:6]), numbers[1][6])
            axis = (end - begin) / numpy.linalg.norm(end - begin)
            cosine, sine = numpy.cos(numpy.radians(angle)), numpy.sin(
                numpy.radians(angle))
            arms = points - begin
            points = (begin + cosine * arms + sine * numpy.cross(axis, arms)
                      + (1 - cosine) * numpy.outer(arms @ axis, axis))
        self.points[first:] = points.tolist()

    def read_node(self, options, lines):
        for line in lines:
            position = [float(word or 0) for word in line[1:4]]
            self.add_node(int(line[0]), position + [0.] * (3 - len(position)), options)

    def add_node(self, label, position, options):
        self.scope.nodes[label] = len(self.points)
        self.points.append(list(position))
        if "NSET" in options:
            self.group("nsets", options["NSET"]).append(self.scope.nodes[label])

    def read_ngen(self, options, lines):
        """Nodes on a line, a parabola (LINE=P), or a circle (LINE=C)."""
        curve = options.get("LINE", "").upper()
        for line in lines:
            first, last, step = (int(word or 1) for word in [*line, ""][:3])
            a, b = (self.position(label) for label in (first, last))
            other = self.position(int(line[3])) if curve else None
            if "NSET" in options:
                self.group("nsets", options["NSET"]).extend(
                    self.scope.nodes[label] for label in (first, last))
            for label in range(first + step, last, step):
                t = (label - first) / (last - first)
                if curve == "P":
                    place = ((1 - t) * (1 - 2 * t) * a + 4 * t * (1 - t) * other
                             + t * (2 * t - 1) * b)
                elif curve == "C":
                    u, v = a - other, b - other
                    angle = numpy.arccos(u @ v / (numpy.linalg.norm(u)
                                                  * numpy.linalg.norm(v)))
                    place = other + (numpy.sin((1 - t) * angle) * u
                                     + numpy.sin(t * angle) * v) / numpy.sin(angle)
                else:
                    place = (1 - t) * a + t * b
                self.add_node(label, place, options)

    def position(self, label):
        return numpy.array(self.points[self.scope.nodes[label]])

    def read_element(self, options, lines):
        kind = options["TYPE"].upper()
        dimension = next((d for names, d in DIMENSIONS if re.match(names, kind)), None)
        if dimension is None:
            self.ignored.add(f"*ELEMENT, TYPE={kind}")
            return
        numbers = [[int(word) for word in line if word] for line in lines]
        n = len(numbers[0]) - 1
        if dimension == 2:
            n = int(re.search(r"(?:[A-Z]|\dD)(\d)", kind.replace("3D", "")).group(1))
        elif dimension == 3:
            n = int(re.search(r"\d+", kind.replace("3D", "")).group())
        # An element may take several lines.
        numbers = numpy.array([*itertools.chain(*numbers)]).reshape(-1, n + 1)
        if dimension == 1 and n == 3:
            numbers = numbers[:, [0, 1, 3, 2]]  # the middle node stands second
        group = self.group("elsets", options["ELSET"]) if "ELSET" in options else []
        for label, *nodes in numbers.tolist():
            group.append(len(self.elements))
            self.scope.elements[label] = len(self.elements)
            self.elements.append((dimension,
                                  [self.scope.nodes[node] for node in nodes]))

    def read_nset(self, options, lines):
        group = self.group("nsets", options["NSET"], "INTERNAL" in options)
        if "ELSET" in options:
            group.extend(node for element in self.members(
                "elsets", options["ELSET"], self.scope_of(options))
                for node in self.elements[element][1])
        group.extend(self.listed("nsets", options, lines))

    def read_elset(self, options, lines):
        self.group("elsets", options["ELSET"], "INTERNAL" in options).extend(
            self.listed("elsets", options, lines))

    def read_surface(self, options, lines):
        kind = options.get("TYPE", "ELEMENT").upper()
        if kind == "NODE":
            self.group("nsets", options["NAME"]).extend(
                node for line in lines
                for node in self.members("nsets", line[0], self.scope))
            return
        if kind != "ELEMENT" or "COMBINE" in options:
            raise ValueError("surfaces of TYPE=ELEMENT and NODE are implemented")
        surface = self.group("surfaces", options["NAME"])
        for name, *faces in lines:
            face = faces[0].upper() if faces else ""
            if not re.fullmatch(r"S\d|SPOS|SNEG|", face):
                raise ValueError(f"{face} is no face; faces are S1 to S6")
            number = int(face[1:]) - 1 if face[1:].isdigit() else None
            surface.extend((element, number) for element in self.members(
                "elsets", name, self.scope))

    def group(self, kind, name, is_internal=False):
        """The members of a set or surface of the scope, to be appended to."""
        self.scope.titles.setdefault((kind, name.upper()), name)
        if is_internal:
            self.scope.internal.add((kind, name.upper()))
        return getattr(self.scope, kind).setdefault(name.upper(), [])

    def scope_of(self, options):
        return (self.instances[options["INSTANCE"].upper()]
                if "INSTANCE" in options else self.scope)

    def listed(self, kind, options, lines):
        """Members that the lines of a set list or generate."""
        scope = self.scope_of(options)
        for line in lines:
            if "GENERATE" in options:
                first, last, step = (int(word) for word in [*filter(None, line), 1][:3])
                line = range(first, last + 1, step)
            for word in line:
                yield from self.members(kind, str(word), scope)

    def members(self, kind, word, scope):
        """Indices that a label or the name of a set means, maybe of an instance:
        "PART-1-1.LIP"."""
        instance, _, rest = word.upper().rpartition(".")
        if instance in self.instances:
            word, scope = rest, self.instances[instance]
        if not word:
            return []
        if not word.isdecimal():
            return getattr(scope, kind)[word.upper()]
        known = scope.nodes if kind == "nsets" else scope.elements
        return [known[int(word)]] if int(word) in known else []

    def mesh(self):
        mesh = Mesh(self.points)
        # Elements of a dimension and number of nodes become a block.
        blocks = collections.defaultdict(list)
        for element, (dimension, nodes) in enumerate(self.elements):
            blocks[dimension, len(nodes)].append(element)
        index = {}
        for (dimension, n), members in blocks.items():
            index.update(zip(members, mesh.add(
                dimension, [self.elements[element][1] for element in members],
                f"an element with {n} nodes")))
        scopes = {"": self.assembly, **self.instances}
        count = collections.Counter(key for scope in scopes.values()
                                    for key in scope.titles)
        for instance, scope in scopes.items():
            for (kind, key), title in scope.titles.items():
                if (kind, key) in scope.internal:
                    continue
                name = (f"{instance}.{title}" if instance and count[kind, key] > 1
                        else title)
                members = getattr(scope, kind)[key]
                if kind == "nsets":
                    mesh.nodes[name].extend(members)
                elif kind == "elsets":
                    mesh.elements[name].extend(index[element] for element in members)
                else:
                    mesh.faces[name].extend((index[element], face)
                                            for element, face in members)
        if self.ignored:
            mesh.notes.append("keywords that do not belong to the mesh: "
                              + ", ".join(sorted(self.ignored)))
        return mesh

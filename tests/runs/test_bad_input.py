"""Whatever the user gets wrong is answered by the promised exit status and by a
message that names the place and what is allowed, and never by a backtrace."""

import json
import pathlib
import re
import shutil
from typing import NamedTuple

from crevasse_run import SOURCE, check, execute, overrides, plain, tier

MESHES = SOURCE / "tests" / "meshes"

# Lines are counted in the expectations below.
SCENE = """\
subsection Geometry
  set Shape        = edge crack
  set Subdivisions = 4, 2
end
subsection Material
  set Relaxation time = 60
end
subsection Loads
  set Period   = 600
  set Traction = 0; sin(2*pi*t/600)
end
subsection Time integration
  set Steps per period = 10
end
subsection Periodic state
  set Maximum periods = 2
  set Tolerance       = 0
end
subsection Output
  set Probes = A: 1, 0
end
"""

MESH_SCENE = f"""\
subsection Geometry
  set Shape     = mesh file
  set Mesh file = {MESHES}/edge_crack_4.msh
end
subsection Boundary
  set Symmetry     = 1
  set Contact      = 2
  set Loaded       = 3
  set Fixed points = 0.5, 0: 1
end
"""


class Case(NamedTuple):
    name: str
    status: int
    messages: list  # regular expressions that standard error must match
    settings: list = []
    scene: str = SCENE
    suffix: str = ".prm"
    creates_directory: bool = False


def mesh(name):
    return f"Geometry/Mesh file={MESHES}/{name}.msh"


def contradiction(name):
    """A mesh that contradicts itself."""
    return f"Geometry/Mesh file={SOURCE}/tests/fuzz/corpus_mesh/{name}.msh"


IN_SPACE = ["Dimension=3", "Geometry/Subdivisions=2, 2, 1"]

EDITED_MESHES = {  # of edge_crack_2.msh: a line, another one for it, and the message
    "a_node_twice": ("16 3 2 10 1 11 14 13 10", "16 3 2 10 1 11 14 13 11",
                     r"element 16, at \(0.25, 1, 0\): a node occurs twice.*Singular functions"),
    "nodes_of_one_place": ("14 0.25 0.5 0", "14 0.25 1 0", "or two have one place"),
    "two_orders": ("2 1 2 1 1 6 5", "2 8 2 1 1 6 5 13",
                   "curve 1 has elements of first and of second order; all must have one"),
    "a_negative_group": ("3 1 2 2 2 5 7", "3 1 2 -2 9 5 7",
                         "curve -2 belongs to the physical group -2; groups must be "
                         "numbered from 0"),
    "a_face_of_three_cells": ("12 3 2 10 1 9 15 8 3", "12 3 2 10 1 7 15 8 3",
                              "are a face of this cell and of two others"),
    "a_face_of_two_groups": ("4 1 2 2 2 7 2", "4 1 2 2 2 5 6",
                             r'belongs to the physical groups "ligament" \(1\) and "lip" '
                             r"\(2\), to which the scene gives different roles"),
}

CASES = [
    # Dimensions
    Case("dimension", 2, ["Dimension = 4: must be 2 or 3"], ["Dimension=4"]),
    Case("box_in_the_plane", 2,
         [r"\[Geometry\] Shape = box: is not allowed with Dimension = 2; the "
          r'body without a crack is "rectangle"'],
         ["Geometry/Shape=box"]),
    Case("rectangle_in_space", 2,
         [r"\[Geometry\] Shape = rectangle: is not allowed with Dimension = 3; "
          r'the body without a crack is "box"'],
         IN_SPACE + ["Geometry/Shape=rectangle"]),
    Case("components_in_space", 2,
         [r"\[Geometry\] Subdivisions = 4, 2: must be 3 integers",
          r"\[Loads\] Traction = 0; 1: must be 3 formulas",
          r'\[Boundary\] Fixed points = 0, 0: "0, 0" must be 3 coordinates',
          r'\[Output\] Probes = A: 1, 0: "1, 0" must be 3 coordinates'],
         ["Dimension=3", "Geometry/Subdivisions=4, 2", "Loads/Traction=0; 1",
          "Boundary/Fixed points=0, 0", "Output/Probes=A: 1, 0"]),
    Case("no_thickness", 2,
         [r"\[Geometry\] Thickness = 0: must be a number greater than 0"],
         ["Geometry/Thickness=0"]),
    Case("plane_mesh_in_space", 2,
         [r"Mesh file = .*edge_crack_2\.msh: .*there are no tetrahedra, wedges or "
          "hexahedra", "Allowed: tetrahedra"],
         IN_SPACE + ["Geometry/Shape=mesh file", mesh("edge_crack_2"),
                     "Loads/Traction=", "Output/Probes="]),
    Case("mean_volume_in_plane_stress", 2,
         [r"\[Discretisation\] Volumetric strain = mean: is not allowed in "
          r"plane stress"],
         ["Discretisation/Volumetric strain=mean"]),
    Case("mean_volume_of_quadratic_elements", 2,
         [r"\[Discretisation\] Volumetric strain = mean: is for linear elements "
          r"only: set Degree = 1"],
         ["Discretisation/Volumetric strain=mean", "Discretisation/Degree=2",
          "Material/Plane state=plane strain"]),

    # Names
    Case("unknown_parameter", 2,
         [r'unknown_parameter\.prm:2: \[Geometry\] unknown parameter "Crack '
          r'lenght"', "allowed here: Shape, Width, Height, Thickness",
          'did you mean "Crack length"'],
         scene="subsection Geometry\n  set Crack lenght = 1\nend\n"),
    Case("parameter_of_another_section", 2,
         [r'another_section\.prm:2: \[Loads\] unknown parameter '
          r'"Young modulus"', "is in the section Material"],
         scene="subsection Loads\n  set Young modulus = 1\nend\n"),
    Case("misspelt_section", 2,
         [r'misspelt_section\.prm:2: unknown section "Materail"',
          "sections are: Geometry, Boundary, Material",
          'did you mean "Material"'],
         scene="# a comment\nsubsection Materail\n  set Anything = 1\nend\n"),
    Case("section_not_closed", 2,
         [r'section_not_closed\.prm:1: the subsection "Geometry" is never '
          r'closed by an "end"'],
         scene="subsection Geometry\n  set Width = 2\n"),
    Case("line_not_understood", 2,
         [r'line_not_understood\.prm:1: "Width = 2" cannot be understood',
          '"set Name = value"'],
         scene="Width = 2\n\n"),
    Case("set_twice", 2,
         [r"set_twice\.prm:2: Title is set a second time; it was set at "
          r"set_twice\.prm:1"],
         scene="set Title = a\nset Title = b\n"),
    Case("unknown_section_of_override", 2,
         [r'--set "Materail/E=1": unknown section "Materail"',
          'did you mean "Material"'],
         ["Materail/E=1"]),
    Case("malformed_override", 2,
         ['--set "Width": must have the form "Section/Name=value"'],
         ["Width"]),
    Case("missing_include", 4,
         [r'missing_include\.prm:1: The file "nowhere\.prm" cannot be read: No '
          r'such file'],
         scene="include nowhere.prm\n\n"),
    Case("json_syntax", 2,
         [r"json_syntax\.json: is not valid JSON: .*line 1, column 26"],
         scene='{"Geometry": {"Width": 1,}}\n', suffix=".json"),
    Case("json_name", 2,
         [r'json_name\.json: \[Geometry\] unknown parameter "Widht"',
          'did you mean "Width"'],
         scene='{"Geometry": {"Widht": 1}}\n', suffix=".json"),
    Case("neither_prm_nor_json", 2,
         [r"neither_prm_nor_json\.txt: the name of a scene file must end in "
          r"\.prm or \.json"],
         suffix=".txt"),

    Case("json_number", 2, ["json_number.json: must be one JSON object"],
         scene="3\n", suffix=".json"),
    Case("json_name_twice", 2, ['json_name_twice.json: "Width" occurs twice'],
         scene='{"Geometry": {"Width": 1, "Width": 2}}\n', suffix=".json"),
    Case("json_list_of_texts", 2,
         [r"\[Geometry\] Subdivisions: must be a number, true or false, a text, or an "
          "array of numbers"],
         scene='{"Geometry": {"Subdivisions": [4, "2"]}}\n', suffix=".json"),
    Case("json_comment", 2, [r"Title = a # b: must not contain \"#\", which begins"],
         scene='{"Title": "a # b"}\n', suffix=".json"),
    Case("json_control_character", 2, ["Title.*: must not contain control characters"],
         scene='{"Title": "a\\u0007"}\n', suffix=".json"),
    Case("includes_itself", 2, ['the file "includes_itself.prm" includes itself'],
         scene="include includes_itself.prm\n\n"),
    Case("section_in_a_section", 2,
         [r'unknown section "Geometry/Material".*; sections do not nest, so an "end" may '
          "be missing before it"],
         scene="subsection Geometry\nsubsection Material\nend\nend\n"),
    Case("unknown_parameter_at_the_top", 2,
         [r'unknown parameter "Titel"; .*, and the sections Geometry, Boundary',
          'did you mean "Title"'],
         scene="set Titel = a\n\n"),

    # Values
    Case("cut_between_letters", 2, [r"\[Geometry\] Width = aä+\.\.\.: must be a number"],
         ["Geometry/Width=a" + 500 * "ä"]),
    Case("texts_for_subdivisions", 2,
         ["Subdivisions = 4, many: must be automatic, or as many integers of at least 1"],
         ["Geometry/Subdivisions=4, many"]),
    Case("boundary_that_is_no_integer", 2,
         [r'\[Boundary\] Loaded = 3, 1\.5: must be "automatic", "none" or boundary ids'],
         ["Boundary/Loaded=3, 1.5"]),
    Case("fixed_points", 2,
         [r'"0, 0: 0": after the colon the numbers of components must follow'],
         ["Boundary/Fixed points=0, 0: 0"]),
    Case("fixed_component", 2, ['"3" must be the number of a component, 1 to 2'],
         ["Boundary/Fixed points=0, 0: 3"]),
    Case("relaxation_factor", 2, ['Relaxation factor = 2: must be "automatic" or a number'],
         ["Contact/Solver=projected sor", "Contact/Relaxation factor=2"]),
    Case("chain_without_times", 2,
         ['"0.5" must be "fraction: relaxation time" with a number greater than 0'],
         ["Material/Viscosity=chain", "Material/Chain=0.5"]),
    Case("chain_stiffer_than_the_body", 2, [r"the sum of the fractions is 1\.1; it must not"],
         ["Material/Viscosity=chain", "Material/Chain=0.5: 10; 0.6: 90"]),
    Case("empty_formula", 2, ["it is empty"], ["Loads/Traction=; 1"]),
    Case("formula_that_assigns", 2, ['"=" assigns; use "==" to compare'],
         ["Loads/Traction=0; t = 3"]),
    Case("comma_in_a_number", 2, ["the comma makes it 2 formulas; numbers have a decimal"],
         ["Loads/Traction=0; 1,5"]),
    Case("probe_with_a_blank", 2, ['the probe name "A B" must consist of letters'],
         ["Output/Probes=A B: 1, 0"]),
    Case("probe_without_name", 2, ['"1, 0" must be "name: x, y"'], ["Output/Probes=1, 0"]),
    Case("probes_of_one_name", 2, ['the probe name "A" must be that of one probe only'],
         ["Output/Probes=A: 1, 0; A: 0, 1"]),
    Case("probe_at_a_letter", 2, ['"1, y" must be coordinates, separated by commas'],
         ["Output/Probes=A: 1, y"]),
    Case("no_factor_to_condense_with", 2,
         [r"\[Contact\] Solver = condensed active set needs a factorisation"],
         ["Contact/Solver=condensed active set", "Linear solver/Type=amg"]),
    Case("negative_modulus", 2,
         [r"negative_modulus\.prm:2: \[Material\] Young modulus = -13000: must "
          r"be greater than 0"],
         scene="subsection Material\n  set Young modulus = -13000\nend\n"),
    Case("not_a_number", 2,
         [r"\[Geometry\] Width = wide: must be a number greater than 0"],
         ["Geometry/Width=wide"]),
    Case("not_a_choice", 2,
         [r"\[Geometry\] Shape = edge_crack: must be one of: edge crack, "
          r"centre crack, rectangle, box, mesh file; did you mean \"edge crack\"\?"],
         ["Geometry/Shape=edge_crack"]),
    Case("crack_longer_than_plate", 2,
         [r"\[Geometry\] Crack length = 1.5: must be shorter than the plate: "
          r"Width = 1"],
         ["Geometry/Crack length=1.5"]),
    Case("formula", 2,
         [r"formula\.prm:2: \[Loads\] Traction = 0; 1 \+ \* t: the formula "
          r'"1 \+ \* t" cannot be used: .*"\*".* position 4'],
         scene="subsection Loads\n  set Traction = 0; 1 + * t\nend\n"),
    Case("formula_with_unknown_name", 2,
         [r'\[Loads\] Body force = 0; rho\*g: the formula "rho\*g" cannot be '
          r'used: .*"rho".* position 0', "Known names: x, y, z, t, pi"],
         ["Loads/Body force=0; rho*g"]),
    Case("traction_without_value", 2,
         [r'\[Loads\] Traction: the formula "sqrt\(x-2\)" has no finite value '
          r"at \(\S+, 1\), t = 0: ", r"arguments of sqrt"],
         ["Loads/Traction=0; sqrt(x-2)"]),
    Case("traction_without_value_at_an_instant", 2,
         [r'\[Loads\] Traction: the formula "log\(t\)" has no finite value at '
          "t = 0: "],
         ["Loads/Traction=0; log(t)"]),
    Case("body_force_without_value", 2,
         [r'\[Loads\] Body force: the formula "1/\(t-450\)\*x" has no finite '
          r"value at \(\S+, \S+\), t = 450: "],
         ["Loads/Body force=0; 1/(t-450)*x"]),
    Case("coefficient_without_value", 2,
         [r'\[Material\] Young modulus: the formula "sqrt\(0\.5-x\)" has no '
          r"finite value at \(\S+, \S+\), t = 0: "],
         ["Material/Young modulus=sqrt(0.5-x)"]),
    Case("coefficient_without_value_at_an_instant", 2,
         [r'\[Material\] Relaxation time: the formula "100\+log\(t-60\)" has '
          r"no finite value at t = 0: "],
         ["Material/Relaxation time=100+log(t-60)"]),
    Case("entry_without_value", 2,
         [r'\[Material\] Stiffness matrix: the formula "sqrt\(-1-x\)" has no '
          r"finite value at \(\S+, \S+\), t = 0: "],
         ["Material/Stiffness matrix=9, 2, 0; 2, 9, 0; 0, 0, sqrt(-1-x)"]),
    Case("chain_without_value", 2,
         [r'\[Material\] Chain: the formula "1/\(theta-7\)" has no finite value '
          r"at t = 0, theta = 7: "],
         ["Material/Viscosity=chain", "Material/Chain=0.5: 1/(theta-7)",
          "Loads/Temperature=7"]),
    Case("time_factor_without_value", 2,
         [r'\[Material\] Viscosity time factor: the formula "1/\(t-300\)\^2" has '
          r"no finite value at t = 300: "],
         ["Material/Viscosity time factor=1/(t-300)^2"]),
    Case("temperature_without_value", 2,
         [r'\[Loads\] Temperature: the formula "sqrt\(300-t\)" has no finite '
          r"value at t = 330: "],
         ["Material/Thermal expansion=1e-5", "Loads/Temperature=sqrt(300-t)"]),
    Case("temperature_that_is_no_formula", 2,
         [r'--set "Loads/Temperature=20 \+": \[Loads\] Temperature = 20 \+: '
          r'the formula "20 \+" cannot be used: '],
         ["Loads/Temperature=20 +"]),
    Case("thermal_strain_beyond_all_numbers", 2,
         [r"\[Material\] Thermal expansion and \[Loads\] Temperature: the "
          r"thermal strain is \S+ at \(\S+, \S+\), t = \S+ .*; it must be "
          r"from -1e70 to 1e70"],
         ["Material/Thermal expansion=1e30",
          "Loads/Temperature=1e50*t*x"]),
    Case("thermal_expansion_beyond_all_numbers", 2,
         [r"\[Material\] Thermal expansion = 1e80: every entry must be "
          r"from -1e70 to 1e70"],
         ["Material/Thermal expansion=1e80"]),
    Case("no_matrix", 2,
         [r'--set "Material/Viscosity matrix=": \[Material\] Viscosity matrix = '
          r"\(empty\): must be given with Viscosity = matrix: rows separated by "
          "semicolons"],
         ["Material/Viscosity=matrix", "Material/Viscosity matrix="]),
    Case("matrix_of_another_size", 2,
         [r"^crevasse: matrix_of_another_size\.prm:2: \[Material\] Stiffness "
          r"matrix = 1, 2; 2, 1: must have 3 \(11, 22, 12\) or 4 \(11, 22, 33, "
          r"12\) rows, separated by semicolons; it has 2\n"],
         scene="subsection Material\n"
               "  set Stiffness matrix = 1, 2; 2, 1\nend\n"),
    Case("row_of_another_size", 2,
         [r"^crevasse: row_of_another_size\.prm:2: \[Material\] Stiffness "
          r'matrix = .*: the row "2, 1" must have 4 entries, separated by '
          r"commas; it has 2\n"],
         scene="subsection Material\n"
               "  set Stiffness matrix = 9, 2, 2, 0; 2, 1; 2, 2, 9, 0; 0\n"
               "  set Plane state = plane strain\nend\n"),
    Case("matrix_beyond_all_numbers", 2,
         [r"\[Material\] Viscosity matrix = .*: every entry must be from "
          "-1e70 to 1e70"],
         ["Material/Viscosity=matrix",
          "Material/Viscosity matrix=1e200, 0, 0; 0, 1e200, 0; 0, 0, 1e200"]),
    Case("matrix_beyond_all_numbers_somewhere", 2,
         [r"\[Material\] Stiffness matrix = .*: has the largest entry \S+ at "
          ".*; must be from 1e-70 to 1e70"],
         ["Material/Stiffness matrix=1e200*x, 0, 0; 0, 1e200*x, 0; "
          "0, 0, 1e200*x"]),
    Case("components_of_traction", 2,
         [r"\[Loads\] Traction = 0; t; 0: must be 2 formulas, one for each "
          r"dimension, separated by semicolons"],
         ["Loads/Traction=0; t; 0"]),
    Case("positive_gap", 2,
         [r"\[Boundary\] Gap = 0.1: must be at most 0"],
         ["Boundary/Gap=0.1"]),
    Case("gap_positive_somewhere", 2,
         [r"\[Boundary\] Gap = x-0.8: is 0\.2 at \(1,? 0\); it must be at most "
          r"0"],
         ["Boundary/Gap=x-0.8"]),
    Case("sizes_beyond_all_numbers", 2,
         [r"\[Geometry\] Width = 1e-200: must be a number greater than 0, from "
          "1e-70 to 1e70"],
         ["Geometry/Width=1e-200", "Geometry/Crack length=1e-201"]),
    Case("loads_beyond_all_numbers", 2,
         [r"\[Loads\]: the largest force on a node over a period is \S+; it "
          "must be from 1e-70 to 1e70. Choose other units"],
         ["Loads/Traction=0; 1e200*sin(t)"]),
    Case("instants_not_increasing", 2,
         [r"\[Time integration\] Steps = 300, 200: 200 must be later than the "
          r"previous instant, 300"],
         ["Time integration/Step control=list",
          "Time integration/Steps=300, 200"]),
    Case("probe_outside", 2,
         [r"\[Output\] Probes: far at \(3,? 0\) lies outside the mesh"],
         ["Output/Probes=near: 1, 0; far: 3, 0"]),
    Case("several_errors", 2,
         [r'^crevasse: 5 problems:\n'
          r'several_errors\.prm:2: \[Geometry\] unknown parameter "Depth".*\n'
          r"several_errors\.prm:3: \[Geometry\] Height = 0: must be a number "
          r"greater than 0, from 1e-70 to 1e70\n"
          r'several_errors\.prm:5: unknown section "Load"',
          r'--set "Material/Poisson ratio=0.6": \[Material\] Poisson ratio = '
          r"0.6: must be at least -0.999 and less than 0.5",
          r'--set "Loads/Traction=0": \[Loads\] Traction = 0: must be 2'],
         ["Material/Poisson ratio=0.6", "Loads/Traction=0"],
         scene="subsection Geometry\n  set Depth = 1\n  set Height = 0\nend\n"
               "subsection Load\nend\n"),

    # Boundaries and meshes
    Case("boundary_id_without_face", 2,
         [r"\[Boundary\] Loaded = 7: no face of the mesh has this boundary id",
          "there are: 0 1 2 3 4"],
         ["Boundary/Loaded=3, 7"]),
    Case("two_roles", 2,
         [r"\[Boundary\] Symmetry = 3: the boundary id 3 must have one role "
          r"only, but Clamped names it as well"],
         ["Boundary/Clamped=3", "Boundary/Symmetry=3"]),
    Case("fixed_point_beside_vertex", 2,
         [r"\[Boundary\] Fixed points.*0\.3,? 0.* is no vertex of the mesh",
          r"the nearest one is .*0\.25,? 0"],
         ["Boundary/Fixed points=0.3, 0"]),
    Case("missing_mesh_file", 4,
         [r"^crevasse: missing_mesh_file\.prm:3: \[Geometry\] Mesh file = "
          r"nowhere\.msh: cannot be read: No such file or directory\. If a script "
          r"or a \.geo file makes it, as the scene's comments may tell, run that "
          r"first\n"],
         scene="subsection Geometry\n  set Shape = mesh file\n"
               "  set Mesh file = nowhere.msh\nend\n"),
    Case("mesh_file_that_is_a_directory", 4,
         [r"\[Geometry\] Mesh file = /.*/tests/meshes: cannot be read: it is a "
          "directory"],
         [f"Geometry/Mesh file={MESHES}"], scene=MESH_SCENE),
    Case("missing_mesh_file_and_more", 2,
         [r"2 problems:\n", r"Mesh file = nowhere\.msh: cannot be read: No such",
          "Period = -1: must be a number greater than 0"],
         ["Geometry/Mesh file=nowhere.msh", "Loads/Period=-1"],
         scene=MESH_SCENE),
    Case("no_mesh_file", 2,
         [r"\[Geometry\] Mesh file = \(empty\): must be given with Shape = mesh "
          "file"],
         ["Geometry/Mesh file="], scene=MESH_SCENE),
    Case("empty_mesh_file", 2,
         [r"\[Geometry\] Mesh file = /.*/empty\.msh: is empty"],
         ["Geometry/Mesh file=empty.msh"], scene=MESH_SCENE),
    Case("missing_series", 4,
         [r"^crevasse: missing_series\.prm:2: \[Loads\] Temperature = "
          r"nowhere\.h5: cannot be read: No such file or directory\n"],
         scene="subsection Loads\n  set Temperature = nowhere.h5\nend\n"),
    Case("empty_series", 2,
         [r"\[Loads\] Temperature = /.*/empty\.h5: is empty"],
         ["Loads/Temperature=empty.h5"]),
    Case("table_that_is_not_converted", 2,
         [r"\[Loads\] Temperature = table\.csv: tables and fields of other programs "
          r'must be converted first: "crevasse temperature table\.csv --output'],
         ["Loads/Temperature=table.csv"]),
    Case("not_a_mesh", 2,
         [r"\[Geometry\] Mesh file = /.*not_a_mesh\.prm: cannot be read as a mesh",
          r"Allowed: .*Gmsh file \(\.msh\)"],
         ["Geometry/Mesh file=not_a_mesh.prm"], scene=MESH_SCENE),
    Case("not_a_gmsh_file", 2,
         [r"not_a_gmsh_file\.msh: cannot be read as a mesh: it does "
          r'not begin with "\$MeshFormat"',
          r"Allowed: .*Gmsh file"],
         ["Geometry/Mesh file=not_a_gmsh_file.msh"], scene=MESH_SCENE),
    Case("broken_off_2", 2,
         [r"broken_off_2\.msh: cannot be read as a mesh: Gmsh says: Error "
          "loading"],
         ["Geometry/Mesh file=broken_off_2.msh"], scene=MESH_SCENE),
    Case("broken_off_4", 2,
         [r"broken_off_4\.msh: cannot be read as a mesh: Gmsh says: Could not "
          "read elements"],
         ["Geometry/Mesh file=broken_off_4.msh"], scene=MESH_SCENE),
    Case("more_nodes_than_announced", 2,
         ["there are 15 nodes, but 3 are announced"],
         [contradiction("more_nodes_than_announced")], scene=MESH_SCENE),
    Case("entity_of_9_dimensions", 2,
         ["Gmsh says: Unknown entity 1 of dimension 9"],
         [contradiction("entity_of_9_dimensions")], scene=MESH_SCENE),
    Case("boundary_without_cell", 2,
         ["element 3: the nodes 1, 6 are no face of a cell"],
         [contradiction("boundary_without_cell")], scene=MESH_SCENE),
    Case("two_boundary_ids", 2,
         [r'belongs to the physical groups "top" \(3\) and "lips" \(2\), to which'],
         [contradiction("two_boundary_ids")], scene=MESH_SCENE),
    Case("boundary_within", 2,
         ["element 3: the nodes 4, 5 are a face within the body, between the elements 7 "
          "and 9, and its group"],
         [contradiction("face_within")], scene=MESH_SCENE),
    *[Case(f"mesh_with_{name}", 2, [message], [f"Geometry/Mesh file=mesh_with_{name}.msh"],
           scene=MESH_SCENE) for name, (_, _, message) in EDITED_MESHES.items()],
    Case("mesh_with_two_tips", 2,
         [r"Stress intensity = true: the mesh has 2 crack tips, at \(0\.5, 0\) and "
          r"\(0\.75, 0\), but one is allowed"],
         ["Geometry/Mesh file=two_tips.msh", "Crack tip/Stress intensity=true"],
         scene=MESH_SCENE),
    Case("mesh_without_groups", 2,
         [r"3 problems:\n(.*no face of the mesh has this boundary id; there are: 0\. "
          r"0 is the id of faces in no physical group: .* Physical Curve\(.*\n?){3}"],
         ["Geometry/Mesh file=no_groups.msh"], scene=MESH_SCENE),
    Case("names_in_a_mesh_without_groups", 2,
         [r'no boundary named "lip"; its names: none\. In Gmsh, Physical Curve\("lip"'],
         ["Geometry/Mesh file=no_groups.msh", "Boundary/Contact=lip"],
         scene=MESH_SCENE),
    Case("cells_in_no_group", 2,
         [r"there are no triangles or quadrilaterals, .* put the body into one too, as by Physical "
          "Surface"],
         ["Geometry/Mesh file=no_cells.msh"], scene=MESH_SCENE),
    Case("name_that_no_cell_has", 2,
         [r"\[Material\] Young modulus = .*: no cell of the mesh has the material id 11 "
          r"\(blade\); there are: 10 \(body\)",
          r"\[Material\] Thermal expansion = .* id 12; there are"],
         ["Geometry/Mesh file=no_blade.msh",
          'Material/Young modulus=if(material == "blade", 2, 1)',
          "Material/Thermal expansion=if(12 != material, 2, 1)"], scene=MESH_SCENE),
    Case("material_of_a_built_in_shape", 2,
         [r"Relaxation time = .*: no cell of the mesh has the material id 1; there "
          "are: 0"],
         ["Material/Relaxation time=if(material == 1, 60, 90)"]),
    Case("mesh_of_another_format_inp", 2, ["element 1, .*: a node occurs twice"],
         ["Geometry/Mesh file=mesh.inp"], scene=MESH_SCENE),
    *[Case(f"mesh_of_another_format_{suffix}", 2,
           [rf"\[Geometry\] Mesh file = /.*/mesh\.{suffix}: cannot be read as a mesh: "
            r"deal\.II knows no format .* crevasse mesh .*\nAllowed: .*\n$"],
           [f"Geometry/Mesh file=mesh.{suffix}"], scene=MESH_SCENE)
      for suffix in ("ucd", "other")],
    Case("name_of_cells", 2,
         ['no boundary named "body": it is a Surface, but with this Dimension it must '
          "be a Curve"],
         [mesh("edge_crack_4"), "Boundary/Contact=body"], scene=MESH_SCENE),
    Case("growth_table_in_no_file", 4,
         [r"\[Crack tip\] Growth table = none.csv: cannot be read: No such file"],
         ["Crack tip/Crack growth law=table", "Crack tip/Growth table=none.csv",
          "Crack tip/Stress intensity=true"]),
    Case("name_in_no_file", 4, [r"none\.inp: cannot be read: No such file"],
         ["Geometry/Mesh file=none.inp", "Boundary/Contact=lip"], scene=MESH_SCENE),
    Case("unknown_boundary_name", 2,
         [r'\[Boundary\] Contact = lips, top: the mesh file has no boundary '
          r'named "lips"; its names: "ligament" \(1\), "lip" \(2\), "top"'],
         ["Boundary/Contact=lips, top"], scene=MESH_SCENE),
    Case("field_of_another_program", 2,
         [r"Temperature = furnace\.pvd: .*\"crevasse temperature furnace\.pvd "
          "--output"],
         ["Loads/Temperature=furnace.pvd"]),
    Case("concave_cell", 2,
         [r"\[Geometry\] Mesh file = .*concave\.msh: the cell around \(0\.3, "
          r"0\.3\)", "every cell must be convex"],
         [mesh("concave")], scene=MESH_SCENE),
    Case("lips_of_a_full_model", 2,
         [r"\[Boundary\] Contact or Crack: at \(0\.5,? 0\) lips meet whose "
          "openings depend on each other", "the role Crack", "as Symmetry"],
         [mesh("slit"), "Boundary/Clamped=1", "Boundary/Symmetry=none",
          "Boundary/Fixed points=none"], scene=MESH_SCENE),
    Case("lips_of_a_full_model_held", 2,
         [r"\[Boundary\] Contact or Crack: at \(0\.5,? 0\) lips meet"],
         [mesh("slit"), "Boundary/Clamped=1", "Boundary/Symmetry=none",
          "Boundary/Fixed points=0.5, 0"], scene=MESH_SCENE),
    Case("support_on_inclined_symmetry", 2,
         [r"\[Boundary\] Fixed points: component [12] at \(0, 0\)",
          "already tied to another one"],
         [mesh("inclined_symmetry"), "Boundary/Symmetry=10",
          "Boundary/Contact=none", "Boundary/Loaded=13", "Boundary/Clamped=11",
          "Boundary/Fixed points=0, 0"], scene=MESH_SCENE),
    Case("nothing_to_load", 2,
         [r"\[Loads\] Traction = .*: no boundary has the role Loaded"],
         ["Boundary/Loaded=none"]),
    Case("load_taken_away", 2,
         [r"\[Loads\] Traction = .*: no boundary has the role Loaded",
          "is the boundary id 3, which has another role"],
         ["Boundary/Clamped=3"]),
    Case("comparison_with_a_gap", 2,
         [r"\[Output\] Elastic comparison", "without initial opening"],
         ["Boundary/Gap=-1e-4", "Output/Elastic comparison=closed"]),
    Case("comparison_of_moving_loads", 2,
         [r"\[Output\] Elastic comparison = open: the loads at t = ",
          r"loads F\(t\) p\(x\) only"],
         ["Loads/Traction=0; 10*sin(2*pi*t/600)*x + cos(2*pi*t/600)",
          "Output/Elastic comparison=open"]),
    Case("comparison_with_another_flow", 2,
         [r"\[Output\] Elastic comparison = open: .* viscosity in proportion "
          r"to the stiffness \(\[Material\] Viscosity = relaxation time\)"],
         ["Material/Viscosity=isotropic", "Material/Viscous modulus=60",
          "Output/Elastic comparison=open"]),
    Case("comparison_of_a_lip_that_opens", 2,
         [r"\[Output\] Elastic comparison = closed: the loads F\(t\) p\(x\) "
          "change their sign"],
         ["Output/Elastic comparison=closed"]),
    Case("more_memory_than_there_is", 2,
         [r"The run \(\d+ MB.* fields \d+.*\) needs about .* GB of memory, "
          r"but the machine has .* GB left. .* \[Periodic state\] Anderson depth",
          "about 0 unknowns fit; the mesh has 30"],
         ["Periodic state/Method=anderson",
          "Periodic state/Anderson depth=1000000000"]),
    Case("mesh_that_no_memory_holds", 2,  # refused before it is made
         [r"\[Geometry\]: a mesh of about 19660800 cells \(471859200 unknowns\), "
          r"with the linear solver gmg .*, needs about \S+ GB of memory"],
         IN_SPACE + ["Geometry/Subdivisions=10, 10, 6", "Geometry/Refinements=5",
                     "Discretisation/Degree=2", "Linear solver/Type=gmg",
                     "Loads/Traction=", "Output/Probes="]),
    Case("mesh_that_ml_cannot_count", 2,  # nor this one
         [r"\[Linear solver\] Type: amg fails beyond .* million entries .* "
          r"about 3888 million \(4\.8e\+07 unknowns\).* at least 8 processes"],
         IN_SPACE + ["Geometry/Subdivisions=400, 400, 100", "Loads/Traction=",
                     "Output/Probes="]),
    Case("sor_takes_no_gmg", 2,  # though the mesh has coarser ones
         [r"\[Linear solver\] Type: amg fails beyond.* Set \[Contact\] Solver = "
          r"automatic without Relaxation table, and use Type = gmg"],
         IN_SPACE + ["Geometry/Subdivisions=10, 10, 6", "Geometry/Refinements=5",
                     "Contact/Solver=projected sor", "Loads/Traction=",
                     "Output/Probes="]),
    Case("comparison_without_memory", 2,
         [r"\[Output\] Elastic comparison = open: .* change their sign .* "
          "without viscosity"],
         ["Material/Viscosity=none", "Output/Elastic comparison=open"]),
    Case("comparison_tells_of_the_gap_first", 2,
         ["without initial opening"],
         ["Boundary/Gap=-1e-4", "Output/Elastic comparison=open",
          "Loads/Traction=0; 10*sin(2*pi*t/600)*x + cos(2*pi*t/600)"]),
    Case("gap_without_value", 2,
         [r"\[Boundary\] Gap: "], ["Boundary/Gap=-sqrt(x - 2)"]),
    Case("crack_without_length", 2,
         [r"\[Geometry\] Crack length = 1e-17: .*Width = 1"],
         ["Geometry/Crack length=1e-17"]),
    Case("too_many_cells", 2,
         [r'^crevasse: --set "Geometry/Refinements=12": \[Geometry\] Refinements '
          "= 12: makes 134217728 cells of Subdivisions = 4, 2; at most 2e7"],
         ["Geometry/Refinements=12"]),
    Case("too_many_subdivisions", 2,
         [r"^crevasse: --set .*: \[Geometry\] Subdivisions = 5000, 5000: makes "
          r"2\.5e\+07 cells; at most 2e7"],
         ["Geometry/Subdivisions=5000, 5000"]),
    Case("table_without_load", 2,
         [r"\[Contact\] Relaxation table: there is no load"],
         ["Contact/Relaxation table=1.5", "Loads/Traction=0; 0"],
         creates_directory=True),

    # Rigid motions
    Case("free_translation", 3,
         ["Unconstrained rigid-body motions:\n  translation along x1\nContact",
          r"\[Boundary\] Clamped, Symmetry or Fixed points"],
         ["Boundary/Fixed points=none"]),
    Case("free_mesh", 3,
         [r"Unconstrained rigid-body motions:\n(.*\n)+Contact .* Boundary ids of the mesh that have no role: "
          r"0, 1\."],
         ["Boundary/Symmetry=none", "Boundary/Loaded=3", "Boundary/Contact=2",
          "Boundary/Fixed points=none"],
         scene=MESH_SCENE),
    Case("free_rotation", 3,
         [r"Unconstrained rigid-body motions:\n  rotation in the plane x1-x2 about \(0\.5, 0\)\n"
          "Hold each part"],
         ["Boundary/Symmetry=none", "Boundary/Contact=none",
          "Boundary/Fixed points=0.5, 0"]),
    Case("free_to_fly", 3,
         ["Unconstrained rigid-body motions:\n  translation along x1\n  translation along x2\n"
          "  rotation in the plane x1-x2 .*\nHold each part"],
         ["Boundary/Symmetry=none", "Boundary/Contact=none",
          "Boundary/Fixed points=none"]),
    Case("free_part", 3,
         ["Unconstrained rigid-body motions:\n  translation along x1 of part 2 of 2 .*\n"
          "  translation along x2 of part 2 of 2 .*\n"
          "  rotation in the plane x1-x2 .* of part 2 of 2 .*\nHold each part"],
         [mesh("two_parts"), "Boundary/Fixed points=0, 0: 1",
          "Boundary/Contact=none"],
         scene=MESH_SCENE),

    # Instabilities
    Case("unstable_list_of_steps", 3,
         ["time step 598 is too large", "that is below 120",
          r"Add instants to \[Time integration\] Steps"],
         ["Time integration/Step control=list", "Time integration/Steps=1, 2"]),
    Case("relaxation_too_fast_for_any_step", 3,
         ["time step 60 is too large",
          r"a period has at most 1000000 steps, which allow relaxation times "
          r"above 0\.0003\.", r"\[Material\]"],
         ["Material/Relaxation time=1e-27"]),
    Case("relaxation_too_fast_for_any_list", 3,
         ["which allow relaxation times above"],
         ["Material/Relaxation time=1e-27", "Time integration/Step control=list",
          "Time integration/Steps=1, 2"]),
    Case("contact_not_solved", 3,
         ["contact problem was not solved to the accuracy",
          r"\[Contact\] Maximum iterations"],
         ["Contact/Solver=projected sor", "Contact/Maximum iterations=2",
          "Contact/Relaxation factor=1"],
         creates_directory=True),
    Case("rounding_beyond_all_accuracy", 3,
         ["Rounding alone makes such errors here", "very flat cells"],
         ["Geometry/Height=1e-6", "Contact/Solver=active set"],
         creates_directory=True),
]


def check_messages(name, status, output, error, expected_status, messages):
    print(f"--- {name}: exit status {status}\n{error}", end="")
    check(status == expected_status,
          f"{name}: exit status {status} instead of {expected_status}")
    for message in messages:
        check(re.search(message, error), f"{name}: no message like {message}")
    check(error.startswith("crevasse: "), f"{name}: who speaks?")
    for text in ("An error occurred", "Stacktrace", "violated condition",
                 "uncaught", "terminate called", "what():", "libdeal_ii",
                 "libdeal.ii", "std::", "dealii::", "Crevasse::", "0x"):
        check(text not in error, f"{name}: \"{text}\" on standard error")
        check(text not in output, f"{name}: \"{text}\" on standard output")
    output = output.replace("estimated error", "")  # a column of the table
    check("rror" not in output and "xception" not in output,
          f"{name}: an error on standard output")


def execute_case(case):
    directory = pathlib.Path("results") / case.name
    shutil.rmtree(directory, ignore_errors=True)
    scene = pathlib.Path(case.name + case.suffix)
    scene.write_text(plain(case.scene) if case.scene in (SCENE, MESH_SCENE)
                     else case.scene)
    return execute(scene, "--output", directory, *overrides(case.settings))


def test_cases():
    pathlib.Path("not_a_gmsh_file.msh").write_text(MESH_SCENE)
    pathlib.Path("empty.msh").write_text("")
    whole = (MESHES / "edge_crack_2.msh").read_text()
    groups = re.compile(r"\$PhysicalNames.*\$EndPhysicalNames\n", re.DOTALL)
    pathlib.Path("no_groups.msh").write_text(groups.sub("", re.sub(
        r"^(\d+ [13] 2) \d+ ", r"\1 0 ", whole, flags=re.MULTILINE)))
    edges, n = re.subn(r"^\d+ 3 2 .*\n", "", whole, flags=re.MULTILINE)
    total = int(re.search(r"\$Elements\n(\d+)", whole)[1])
    pathlib.Path("no_cells.msh").write_text(
        edges.replace(f"$Elements\n{total}\n", f"$Elements\n{total - n}\n"))
    pathlib.Path("no_blade.msh").write_text(re.sub(
        r"(\$PhysicalNames\n)(\d+)\n",
        lambda found: f'{found[1]}{int(found[2]) + 1}\n2 11 "blade"\n', whole))
    for name, (line, other, _) in EDITED_MESHES.items():
        check(line in whole, f"{name}: there is no such line")
        pathlib.Path(f"mesh_with_{name}.msh").write_text(whole.replace(line, other))
    pathlib.Path("two_tips.msh").write_text(
        whole.replace("4 1 2 2 2 7 2", "4 1 2 1 1 7 2"))
    pathlib.Path("mesh.inp").write_text(
        "*HEADING\n*NODE\n1, 0., 0.\n*ELEMENT, TYPE=CPS4\n1, 1, 1, 1, 1\n")
    for suffix in ("other", "ucd"):
        pathlib.Path(f"mesh.{suffix}").write_text("nothing\n")
    pathlib.Path("empty.h5").write_text("")
    for version in (2, 4):
        text = (MESHES / f"edge_crack_{version}.msh").read_text()
        path = pathlib.Path(f"broken_off_{version}.msh")
        path.write_text(text[:text.rindex(" ") - 10])
    for case in tier(CASES[::3], CASES):
        check_messages(case.name, *execute_case(case), case.status,
                       case.messages)
        directory = pathlib.Path("results") / case.name
        check(directory.exists() == case.creates_directory,
              f"{case.name}: is there an output directory?")


def test_missing_scene():
    pathlib.Path("missing.prm").write_text(SCENE)
    for name, reason in (("nowhere.prm", r"does not exist\."),
                         ("nowhere.json", r"does not exist\."),
                         ("swep", 'does not exist; did you mean "sweep"'),
                         ("missing", 'does not exist; did you mean "missing.prm"'),
                         (".", "cannot be read: it is a directory")):
        check_messages(name, *execute(name), 4,
                       [f'The file "{re.escape(name)}" ' + reason])


def test_output_directory():
    """Even root can neither make a directory below a file nor in /proc."""
    scene = pathlib.Path("output_directory.prm")
    scene.write_text(plain(SCENE))
    for directory in (scene / "below", "/proc/nonexistent"):
        check_messages(str(directory),
                       *execute(scene, "--quiet", "--output", directory), 4,
                       [rf"^crevasse: --output {directory}: cannot be created",
                        "--output DIR"])
    check_messages("check",
                   *execute(scene, "--check", "--output", scene / "below"), 4,
                   [rf"^crevasse: --output {scene}/below: results cannot be "
                    rf"written there, because /.*{scene} is not a directory"])
    check_messages("parameter",
                   *execute(scene, "--set", f"Output directory={scene}"), 4,
                   [rf"\[Output directory\] {scene}: cannot be"])


def test_what_is_in_the_way():
    """A directory where a file is to be written is found before computing."""
    scene = pathlib.Path("in_the_way.prm")
    scene.write_text(plain(SCENE))
    directory = pathlib.Path("results/in_the_way")
    shutil.rmtree(directory, ignore_errors=True)
    (directory / "solution.pvd").mkdir(parents=True)
    for _ in range(2):  # without and with an earlier run's used.prm
        check_messages("in the way", *execute(scene, "--output", directory), 4,
                       [r"results/in_the_way: solution\.pvd is a directory",
                        "--output DIR"])
        check((directory / "solution.pvd").is_dir(), "it was removed")
        check(not (directory / "log.txt").exists(), "something was computed")
        (directory / "used.prm").write_text(plain(SCENE))


def test_stability_bound():
    """The number of steps in the message is the smallest that will do."""
    scene = pathlib.Path("stability_bound.prm")
    scene.write_text(plain(SCENE))
    directory = pathlib.Path("results/stability_bound")
    shutil.rmtree(directory, ignore_errors=True)

    def execute_with(steps, relaxation_time, *arguments):
        return execute(scene, "--output", directory, *arguments, "--set",
                       f"Time integration/Steps per period={steps}", "--set",
                       f"Material/Relaxation time={relaxation_time}")

    # 120 divides the period exactly, 14 does not; Heun's limit is 2.
    for relaxation_time, needed in ((60, 6), (7, 43)):
        result = execute_with(3, relaxation_time)
        check_messages("stability", *result, 3,
                       ["time step 200 is too large",
                        f"below {2 * relaxation_time}, whatever the mesh",
                        f"Use at least {needed} steps"])
        setting = re.search(r'--set "Time integration/Steps per period=(\d+)"',
                            result[2])
        check(setting, "no setting is suggested")
        check(int(setting[1]) == needed, f"{setting[1]} steps are suggested")
        check_messages("one step less",
                       *execute_with(needed - 1, relaxation_time), 3,
                       [f"Use at least {needed} steps"])
        check(not directory.exists(), "an output directory was created")
        status, _, error = execute_with(needed, relaxation_time, "--check")
        check(status == 0, f"the suggestion does not work: {error}")

    status, _, error = execute_with(6, 60)
    check(status == 0, f"the suggestion does not work: {error}")


def test_not_yet_periodic():
    """Exit status 3, but nothing that was computed is lost."""
    scene = pathlib.Path("not_yet_periodic.prm")
    scene.write_text(plain(SCENE))
    directory = pathlib.Path("results/not_yet_periodic")
    shutil.rmtree(directory, ignore_errors=True)
    result = execute(scene, "--output", directory, "--set",
                     "Periodic state/Tolerance=1e-8")
    check_messages("not yet periodic", *result, 3,
                   [r"not yet periodic: after 2 periods it still changes by "
                    r"\S+ of its maximum, most at \(.*, and its error is not known",
                    "results so far are written",
                    r"\[Periodic state\] Tolerance = 1e-0?8",
                    '"Maximum periods" and continue'])
    log = (directory / "log.txt").read_text()
    check(log.endswith(result[2]), "log.txt does not end with the message")
    for name in ("used.prm", "log.txt", "contact.csv", "periods.csv",
                 "solution.pvd", "summary.json"):
        check((directory / name).stat().st_size > 0, f"{name} is empty")
    lines = (directory / "probe_A.csv").read_text().splitlines()
    check(len(lines) == 1 + 2 * 10 + 1, f"probe_A.csv has {len(lines)} lines")
    summary = json.loads((directory / "summary.json").read_text())
    check(summary["converged"] is False, "summary.json says converged")
    check(summary["periods"] == 2, "summary.json has another number of periods")

    result = execute(scene, "--output", directory, "--set",
                     "Periodic state/Tolerance=1e-8", "--set",
                     "Periodic state/Maximum periods=3")
    check_messages("periods to go", *result, 3,
                   [r'"Maximum periods" \(about \d+ more at the current rate'])


def test_advised_points():
    """Fixed points as the message advises hold a body, a part, and a box."""
    free = ["Boundary/Symmetry=none", "Boundary/Contact=none", "Loads/Traction="]
    for scene, settings, held, vertices in (
            (SCENE, free, "", {"x": 0, "y": 0, "X": 1}),
            (SCENE, IN_SPACE + free + ["Output/Probes="], "",
             {"x": 0, "y": 0, "z": 0, "X": 1, "Y": 1}),
            (MESH_SCENE, [mesh("two_parts"), "Boundary/Contact=none"], "0, 0: 1; ",
             {"x": 2, "y": 0, "X": 3})):
        path = pathlib.Path("advised_points.prm")
        path.write_text(plain(scene))
        _, _, error = execute(path, "--check", *overrides(
            settings + [f"Boundary/Fixed points={held or 'none'}"]))
        advised = re.search(r'vertices of the mesh\): "(.*?)" stop all', error)
        check(advised, f"no points are advised: {error}")
        points = re.sub("[xyzXY]", lambda letter: str(vertices[letter[0]]), advised[1])
        status, _, error = execute(path, "--check", *overrides(
            settings + [f"Boundary/Fixed points={held}{points}"]))
        check(status == 0, f"{held}{points} does not hold the body: {error}")


UNUSED = [  # settings, and the warnings that they give
    (["Geometry/Thickness=2"],
     [r"\[Geometry\] Thickness = 2 is not used: Dimension = 2"]),
    (IN_SPACE + ["Material/Plane state=plane strain", "Loads/Traction=",
                 "Output/Probes="],
     [r"\[Material\] Plane state = plane strain is not used: Dimension = 3"]),
    (["Geometry/Shape=rectangle", "Geometry/Crack length=0.4"],
     [r"\[Geometry\] Crack length = 0\.4 is not used: Shape = rectangle"]),
    (["Boundary/Contact=none", "Boundary/Gap=-1",
      "Contact/Solver=projected sor"],
     [r"\[Boundary\] Gap = -1 is not used: no boundary has the role Contact",
      r"\[Contact\] Solver = projected sor is not used: no boundary"]),
    (["Loads/Traction=", "Boundary/Loaded=3"],
     [r"\[Boundary\] Loaded = 3 is not used: there is no \[Loads\] Traction"]),
    (["Material/Stiffness matrix=9, 2, 0; 2, 9, 0; 0, 0, 3",
      "Material/Young modulus=9", "Material/Poisson ratio=0.1"],
     [r"\[Material\] Young modulus = 9 is not used: Stiffness matrix is given",
      r"\[Material\] Poisson ratio = 0\.1 is not used: Stiffness matrix is"]),
    (["Material/Viscous modulus=2", "Material/Viscous Poisson ratio=0.5",
      "Material/Viscosity matrix=1", "Material/Chain=0.5: 1"],
     [rf"\[Material\] {name} = \S.* is not used: Viscosity = relaxation time"
      for name in ("Viscous modulus", "Viscous Poisson ratio",
                   "Viscosity matrix", "Chain")]),
    (["Material/Viscosity=isotropic", "Material/Viscous modulus=60"],
     [r"\[Material\] Relaxation time = 60 is not used: Viscosity = isotropic"]),
    (["Material/Viscosity=none", "Material/Viscosity time factor=2",
      "Time integration/Scheme=rk4", "Periodic state/Secular split=off"],
     [r"\[Material\] Relaxation time = 60 is not used: Viscosity = none",
      r"\[Material\] Viscosity time factor = 2 is not used: Viscosity = none",
      r"\[Time integration\] Scheme = rk4 is not used: \[Material\] Viscosity",
      r"\[Periodic state\] Secular split = off is not used: \[Material\] Vis",
      r"\[Periodic state\] Maximum periods = 2 is not used: .* one period"]),
    (["Material/Thermal expansion=1e-5"],
     [r"\[Material\] Thermal expansion = 1e-5 is not used: \[Loads\] "
      "Temperature = 0"]),
    (["Loads/Temperature=t"],
     [r"\[Loads\] Temperature = t is not used: \[Material\] Thermal expansion "
      "= 0, and no coefficient depends on theta"]),
    (["Loads/Temperature=sin(2*pi*t/600)", "Material/Relaxation time=60+theta"], []),
    (["Contact/Relaxation factor=1.5"],
     [r"\[Contact\] Relaxation factor = 1\.5 is not used: Solver = automatic"]),
    (["Contact/Solver=projected sor", "Contact/Relaxation factor=1.5"], []),
    (["Contact/Solver=condensed active set", "Contact/Maximum iterations=9",
      "Linear solver/Tolerance=0.01", "Linear solver/Memory for instants=1"],
     [r"\[Contact\] Maximum iterations = 9 is not used: Solver = condensed",
      r"\[Linear solver\] Tolerance = 0\.01\d* is not used: \[Contact\] Solver",
      r"\[Linear solver\] Memory for instants = 1 is not used: the material "
      "does not vary in time"]),
    (["Time integration/Scheme=euler", "Time integration/Heun weight=0.5"],
     [r"\[Time integration\] Heun weight = 0\.5 is not used: Scheme = euler"]),
    (["Time integration/Scheme=exponential", "Material/Relaxation time=1"],
     [r"\[Time integration\] Scheme = exponential with steps of 60 relaxation times is "
      "stable, but under given loads the body creeps"]),
    (["Time integration/Scheme=trapezoid", "Material/Relaxation time=1",
      "Periodic state/Method=march"],
     [r"\[Time integration\] Scheme = trapezoid with steps of 60 relaxation times: .* "
      "oscillates"]),
    (["Time integration/Steps=300"],
     [r"\[Time integration\] Steps = 300 is not used: Step control = uniform"]),
    (["Time integration/Step control=list",
      "Time integration/Steps=100, 200, 300, 400, 500"],
     [r"\[Time integration\] Steps per period = 10 is not used: Step control = "
      "list"]),
    (["Output/Fields=none", "Output/Field times=150"],
     [r"\[Output\] Field times = 150 is not used: Fields = none"]),
    # Used, but probably a mistake.
    (["Material/Thermal expansion=1e-3", "Loads/Temperature=0.5*t*(1+x)"],
     [r"\[Material\] Thermal expansion and \[Loads\] Temperature: the thermal "
      r"strain is up to 0\.5\d+; the theory is for strains much",
      r"\[Loads\] Period = 600: loads or material jump"]),
    (["Loads/Period=1", "Material/Relaxation time=1", "Periodic state/Secular split=on"],
     [r"\[Loads\] Period = 1: loads or material jump at the end of the "
      "period, though no formula has a jump; at t = Period the tables show "
      "the load of t = 0.*applied once needs a longer Period"]),
    (["Material/Thermal expansion=1e-5", "Loads/Temperature=293 + 5*x*sin(2*pi*t/600)"],
     [r"\[Loads\] Temperature is at least 288\.\d+ everywhere and always, as a "
      "temperature in kelvin would be"]),
    (["Material/Thermal expansion=1e-5", "Loads/Temperature=293*sin(2*pi*t/600)^2"],
     []),
    # A condition on the place or the material is no jump in time, one on a
    # temperature that varies is.
    (["Loads/Period=1", "Periodic state/Secular split=on",
      "Material/Relaxation time=if(material == 0 && x < 0.5, 1, 2)"],
     [r"\[Loads\] Period = 1: loads or material jump at the end"]),
    (["Loads/Period=1", "Periodic state/Secular split=off",
      "Loads/Temperature=sin(2*pi*t/600)",
      "Material/Relaxation time=theta > 5 ? 1 : 2"], []),
    # A jump that is meant, and a rounded pi.
    (["Loads/Traction=0; if(t < 300, 1, -1)"], []),
    (["Loads/Traction=0; sin(2*3.1416*t/600)", "Periodic state/Secular split=off"],
     []),
    (["Loads/Traction=0; sin(2*pi*t/60)"],
     [r"\[Time integration\]: within a step the loads differ by 100 % of their "
      r"largest .* Raise Steps per period",
      r"\[Periodic state\] Secular split: the mean load vanishes, but its "]),
]


def warnings_of(scene, settings=()):
    """The warnings of a check, which is passed all the same."""
    status, output, error = execute("--check", scene, *overrides(settings))
    check(status == 0, f"{scene} {settings}: status {status}\n{error}")
    return re.findall("^  warning: (.*)$", output, re.MULTILINE)


def test_end_of_period():
    """Of loads that jump there by a formula with a jump: no warning, but what the tables
    show. Those that return are not mentioned."""
    scene = pathlib.Path("jumps.prm")
    scene.write_text(SCENE)
    line = "end of the period: loads or material jump to their values at t = 0, which"
    for load, n_lines in (("if(t < 300, 1, -1)", 1), ("if(t < 300, t, 600 - t)", 0)):
        status, output, error = execute("--check", scene, "--set",
                                        f"Loads/Traction=0; {load}")
        check(status == 0 and output.count(line) == n_lines
              and "warning" not in output, f"{load}:\n{output}{error}")


def test_unused_parameters():
    """What is set but has no effect is reported, and nothing else."""
    scene = pathlib.Path("unused.prm")
    scene.write_text(SCENE.replace("  set Steps per", "  set Scheme = heun\n  set Steps per"))
    for settings, expected in tier(UNUSED[::3], UNUSED):
        warnings = warnings_of(scene, settings)
        print(f"--- {settings}", *warnings, sep="\n")
        check(len(warnings) == len(expected), f"{settings}: {warnings}")
        for pattern in expected:
            check(any(re.match(pattern, warning) for warning in warnings),
                  f"{settings}: no warning like {pattern}")

    scene.write_text(plain(MESH_SCENE))
    names = ("Width", "Height", "Crack length", "Subdivisions")
    warnings = warnings_of(scene, ["Geometry/Width=2", "Geometry/Height=2",
                                   "Geometry/Crack length=0.1",
                                   "Geometry/Subdivisions=3, 3",
                                   "Loads/Traction=0; 1"])
    check(sorted(warning.split("] ")[1].split(" =")[0] for warning in warnings)
          == sorted(names), f"a mesh file: {warnings}")

    results = pathlib.Path("results/unused")
    scene.write_text(plain(SCENE))
    status, _, error = execute(scene, "--quiet", "--output", results, "--set",
                               "Geometry/Thickness=2")
    check(status == 0, error)
    check("warning: [Geometry] Thickness" in (results / "log.txt").read_text(),
          "log.txt lacks the warning")

    status, output, error = execute(scene, "--output", "results/soft", "--set",
                                    "Material/Young modulus=1e-3")
    check(status == 0, error)
    check(re.search(r"warning: displacements reach \d+\.\d+ in a body of diagonal 1\.414",
                    output), output)

    # used.prm sets everything, but only what differs from the default counts.
    check(len(warnings_of(results / "used.prm")) == 1, "used.prm")
    for path in sorted([*SOURCE.glob(tier("prm/[kt]*.prm", "prm/**/*.prm")),
                        *SOURCE.glob("tests/scenes/*.prm")]):
        if path.name not in ("raous1980_body.prm",  # part of others
                             "penny_crack.prm"):  # its mesh has to be made first
            warnings = warnings_of(path)
            check(not warnings, f"{path}: {warnings}")


test_cases()
test_end_of_period()
test_unused_parameters()
test_missing_scene()
test_output_directory()
test_what_is_in_the_way()
test_stability_bound()
test_advised_points()
test_not_yet_periodic()

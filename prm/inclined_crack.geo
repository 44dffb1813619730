// A plate with a crack in the middle, inclined by 37 degrees, for
// inclined_crack.prm. The mesh beside this file was made by
//   gmsh -2 inclined_crack.geo
SetFactory("OpenCASCADE");
a = 0.25; angle = 37 * Pi / 180; // half of the crack's length
Rectangle(1) = {-1, -1.5, 0, 2, 3};
Point(11) = {-a * Cos(angle), -a * Sin(angle), 0};
Point(12) = {a * Cos(angle), a * Sin(angle), 0};
Line(11) = {11, 12};
Curve{11} In Surface{1};

Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Curve("crack") = {11};
Physical Surface("plate") = {1};

MeshSize{:} = 0.5;
MeshSize{11, 12} = 0.2;
Mesh.RecombineAll = 1;
Mesh.SubdivisionAlgorithm = 1; // quadrilaterals alone
Mesh.MshFileVersion = 2.2;

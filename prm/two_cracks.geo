// A plate with two parallel cracks that pass each other, for two_cracks.prm.
// The mesh beside this file was made by
//   gmsh -2 two_cracks.geo
SetFactory("OpenCASCADE");
Rectangle(1) = {-1, -1, 0, 2, 2};
Point(11) = {-0.5, -0.1, 0};
Point(12) = {0.1, -0.1, 0};
Point(13) = {-0.1, 0.1, 0};
Point(14) = {0.5, 0.1, 0};
Line(11) = {11, 12};
Line(12) = {13, 14};
Curve{11, 12} In Surface{1};

Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Curve("cracks") = {11, 12};
Physical Surface("plate") = {1};

MeshSize{:} = 0.4;
MeshSize{11, 12, 13, 14} = 0.15;
Mesh.RecombineAll = 1;
Mesh.SubdivisionAlgorithm = 1; // quadrilaterals alone
Mesh.MshFileVersion = 2.2;

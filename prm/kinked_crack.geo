// A plate with a hole from whose rim a crack runs to the
// right and kinks upwards, for kinked_crack.prm. The mesh beside this file was
// made by
//   gmsh -2 kinked_crack.geo
radius = 0.25;
Point(1) = {-1, -1, 0};
Point(2) = {1, -1, 0};
Point(3) = {1, 1, 0};
Point(4) = {-1, 1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Point(5) = {0, 0, 0};
Point(6) = {radius, 0, 0};
Point(7) = {0, radius, 0};
Point(8) = {-radius, 0, 0};
Point(9) = {0, -radius, 0};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 8};
Circle(7) = {8, 5, 9};
Circle(8) = {9, 5, 6};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {1, 2};
Point(10) = {radius + 0.2, 0, 0};
Point(11) = {radius + 0.35, 0.15, 0};
Line(9) = {6, 10};
Line(10) = {10, 11};
Curve{9, 10} In Surface{1};

Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Curve("crack") = {9, 10};
Physical Surface("plate") = {1};

MeshSize{:} = 0.4;
MeshSize{6, 10, 11} = 0.1;
MeshSize{7, 8, 9} = 0.25;
Mesh.RecombineAll = 1;
Mesh.SubdivisionAlgorithm = 1; // quadrilaterals alone
Mesh.ElementOrder = 2;         // the rim is round
Mesh.MshFileVersion = 2.2;

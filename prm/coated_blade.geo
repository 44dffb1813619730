// The upper half of the trailing edge of a coated blade for coated_blade.prm: a wedge,
// 12 mm long and 3 to 0.8 mm thick, whose rounded corner is left out, under a coat of
// 0.2 mm. The crack begins at the edge, x = 12. The mesh beside this file was made by
//   gmsh -2 coated_blade.geo
long = 12; tip = 10; root = 1.5; edge = 0.4; coat = 0.2; // mm, halves of a thickness

at_tip = root + (edge - root) * tip / long;
Point(1) = {0, 0, 0};
Point(2) = {tip, 0, 0};
Point(3) = {long, 0, 0};
Point(4) = {0, root, 0};
Point(5) = {tip, at_tip, 0};
Point(6) = {long, edge, 0};
Point(7) = {0, root + coat, 0};
Point(8) = {tip, at_tip + coat, 0};
Point(9) = {long, edge + coat, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {7, 8};
Line(6) = {8, 9};
Line(7) = {1, 4};
Line(8) = {2, 5};
Line(9) = {3, 6};
Line(10) = {4, 7};
Line(11) = {5, 8};
Line(12) = {6, 9};

Curve Loop(1) = {1, 8, -3, -7};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 9, -4, -8};
Plane Surface(2) = {2};
Curve Loop(3) = {3, 11, -5, -10};
Plane Surface(3) = {3};
Curve Loop(4) = {4, 12, -6, -11};
Plane Surface(4) = {4};

Transfinite Curve{1, 3, 5} = 21;
Transfinite Curve{2, 4, 6} = 11;
Transfinite Curve{7, 8, 9} = 7;
Transfinite Curve{10, 11, 12} = 3;
Transfinite Surface{:};
Recombine Surface{:};

Physical Curve("ligament") = {1};
Physical Curve("lip") = {2};
Physical Curve("root") = {7, 10};
Physical Curve("outside") = {5, 6, 9, 12};
Physical Surface("blade") = {1, 2};
Physical Surface("coat") = {3, 4};
Mesh.MshFileVersion = 4.1;

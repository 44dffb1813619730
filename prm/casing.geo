// A quarter of a tube within a casing, for casing.prm. The mesh beside this file
// was made by
//   gmsh -2 -order 2 casing.geo
a = 1; b = 2; c = 2.05;
Point(1) = {0, 0, 0};
Point(2) = {a, 0, 0}; Point(3) = {b, 0, 0}; Point(4) = {c, 0, 0};
Point(5) = {0, a, 0}; Point(6) = {0, b, 0}; Point(7) = {0, c, 0};
Line(1) = {2, 3}; Line(2) = {3, 4};
Line(3) = {5, 6}; Line(4) = {6, 7};
Circle(5) = {2, 1, 5}; Circle(6) = {3, 1, 6}; Circle(7) = {4, 1, 7};
Curve Loop(1) = {1, 6, -3, -5}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 7, -4, -6}; Plane Surface(2) = {2};
Transfinite Curve{1, 3} = 9 Using Progression 1.1;
Transfinite Curve{2, 4} = 2;
Transfinite Curve{5, 6, 7} = 9;
Transfinite Surface{1, 2};
Recombine Surface{1, 2};

Physical Curve("below") = {1, 2};
Physical Curve("left") = {3, 4};
Physical Curve("bore") = {5};
Physical Surface("core") = {1};
Physical Surface("casing") = {2};
Mesh.MshFileVersion = 2.2;

// A plate with an edge crack beside a hole, for curved_path.prm
a = 0.5; // length of the crack
x = 1.1; y = 0.55; r = 0.25; // the hole
Point(1) = {0, -2, 0};
Point(2) = {2, -2, 0};
Point(3) = {2, 2, 0};
Point(4) = {0, 2, 0};
Point(5) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Point(6) = {x, y, 0};
Point(7) = {x + r, y, 0};
Point(8) = {x, y + r, 0};
Point(9) = {x - r, y, 0};
Point(10) = {x, y - r, 0};
Circle(6) = {7, 6, 8};
Circle(7) = {8, 6, 9};
Circle(8) = {9, 6, 10};
Circle(9) = {10, 6, 7};
Curve Loop(1) = {1, 2, 3, 4, 5};
Curve Loop(2) = {6, 7, 8, 9};
Plane Surface(1) = {1, 2};
Point(11) = {a, 0, 0};
Line(10) = {5, 11};
Curve{10} In Surface{1};

Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Curve("crack") = {10};
Physical Surface("plate") = {1};

MeshSize{:} = 0.2;
Mesh.ElementOrder = 2; // the hole is round

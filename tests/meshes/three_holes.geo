// A beam of 20 x 8 with three holes and a notch at x of length a (Bittencourt et al.
// 1996), for test_life_path.py
SetFactory("Built-in");
DefineConstant[ x = {4, Name "notch"} ];
DefineConstant[ a = {1, Name "length"} ];
r = 0.25; w = 0.25;
Point(1) = {0, 0, 0, 1.5};
Point(2) = {1, 0, 0, 0.7};
Point(3) = {x, 0, 0, 0.7};
Point(4) = {19, 0, 0, 0.7};
Point(5) = {20, 0, 0, 1.5};
Point(6) = {20, 8, 0, 1.5};
Point(7) = {10 + w, 8, 0, w};
Point(8) = {10 - w, 8, 0, w};
Point(9) = {0, 8, 0, 1.5};
For i In {1:8}
  Line(i) = {i, i + 1};
EndFor
Line(9) = {9, 1.5};
Curve Loop(1) = {1:9};
loops[] = {1};
For i In {0:2}
  y = 2.75 + 2 * i; p = newp;
  Point(p) = {6, y, 0};
  Point(p + 1) = {6 + r, y, 0, 0.12};
  Point(p + 2) = {6, y + r, 0, 0.12};
  Point(p + 3) = {6 - r, y, 0, 0.12};
  Point(p + 4) = {6, y - r, 0, 0.12};
  l = newl;
  Circle(l) = {p + 1, p, p + 2};
  Circle(l + 1) = {p + 2, p, p + 3};
  Circle(l + 2) = {p + 3, p, p + 4};
  Circle(l + 3) = {p + 4, p, p + 1};
  c = newll;
  Curve Loop(c) = {l:l + 3};
  loops[] += {c};
EndFor
Plane Surface(1) = {loops[]};
tip = newp; Point(tip) = {x, a, 0, 0.3};
crack = newl; Line(crack) = {3, tip};
Curve{crack} In Surface{1};
Physical Curve("load") = {7};
Physical Curve("crack") = {crack};
Physical Surface("beam") = {1};
Mesh.ElementOrder = 2;

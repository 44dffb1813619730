// The upper half of a plate, 100 mm wide and high, with a sleeve in a hole of 20 mm
// and a crack from the rim of the hole through the sleeve into the plate, for
// plate_with_hole.prm. The mesh beside this file was made by
//   gmsh -2 plate_with_hole.geo
half = 50; rim = 10; sleeve = 16; tip = 22; // mm

// Points on the plane of symmetry y = 0, from left to right.
Point(1) = {-half, 0, 0};
Point(2) = {-sleeve, 0, 0};
Point(3) = {-rim, 0, 0};
Point(4) = {rim, 0, 0};
Point(5) = {sleeve, 0, 0};
Point(6) = {tip, 0, 0};
Point(7) = {half, 0, 0};
// The other points: corners, centre, tops of the two circles.
Point(8) = {half, half, 0};
Point(9) = {-half, half, 0};
Point(10) = {0, 0, 0};
Point(11) = {0, rim, 0};
Point(12) = {0, sleeve, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {4, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 9};
Line(8) = {9, 1};
Circle(9) = {4, 10, 11}; // an arc of less than half a circle each
Circle(10) = {11, 10, 3};
Circle(11) = {5, 10, 12};
Circle(12) = {12, 10, 2};

Curve Loop(1) = {3, 11, 12, 2, -10, -9};
Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 6, 7, 8, 1, -12, -11};
Plane Surface(2) = {2};

// Boundaries, which get a role in the scene, and materials.
Physical Curve("ligament") = {1, 2, 5};
Physical Curve("lip") = {3, 4};
Physical Curve("rim") = {9, 10};
Physical Curve("outside") = {6, 7, 8};
Physical Surface("sleeve") = {1};
Physical Surface("plate") = {2};

MeshSize{:} = 16; // mm; SubdivisionAlgorithm halves all sizes
MeshSize{2, 3, 4, 5, 6, 11, 12} = 6;
Mesh.RecombineAll = 1;
Mesh.SubdivisionAlgorithm = 1; // quadrilaterals alone
Mesh.ElementOrder = 2;         // the circles are round
Mesh.MshFileVersion = 4.1;

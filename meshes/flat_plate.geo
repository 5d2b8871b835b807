// A flat plate of quadrilaterals, its upper face on the origin [m].
//     gmsh -2 flat_plate.geo -o flat_plate.msh
Mesh.MshFileVersion = 2.2;

width     = 0.020;
thickness = 0.001;
along     = 40; // cells
across    = 4;

Point(1) = {-width / 2, -thickness, 0};
Point(2) = { width / 2, -thickness, 0};
Point(3) = { width / 2, 0, 0};
Point(4) = {-width / 2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1, 3} = along + 1;
Transfinite Curve {2, 4} = across + 1;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface {1};
Recombine Surface {1};

Physical Curve("base", 1)    = {1};
Physical Curve("crown", 2)   = {3};
Physical Curve("sides", 3)   = {2, 4};
Physical Surface("plate", 4) = {1};

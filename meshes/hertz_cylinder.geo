// The lower cap of a cylinder of radius 50 mm that stands on the origin, 60 mm
// wide, its flat top 40 mm above [m]; quadrilaterals, 0.5 mm wide where contact
// is, growing away from it.
//     gmsh -2 hertz_cylinder.geo -o hertz_cylinder.msh
Mesh.MshFileVersion = 2.2;

R    = 0.05;  // radius
w    = 0.03;  // half width
t    = 0.04;  // height of the top
f    = 0.01;  // half width of the fine part
fine = 40;    // cells along the fine part
side = 13;    // cells from there to a flank
high = 19;    // cells from the arc to the top

Point(1) = {0, R, 0};
Point(2) = {-w, R - Sqrt(R^2 - w^2), 0};
Point(3) = {-f, R - Sqrt(R^2 - f^2), 0};
Point(4) = { f, R - Sqrt(R^2 - f^2), 0};
Point(5) = { w, R - Sqrt(R^2 - w^2), 0};
Point(6) = {-w, t, 0};
Point(7) = {-f, t, 0};
Point(8) = { f, t, 0};
Point(9) = { w, t, 0};

Circle(1) = {3, 1, 2};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {7, 6};
Line(5) = {7, 8};
Line(6) = {8, 9};
Line(7) = {2, 6};
Line(8) = {3, 7};
Line(9) = {4, 8};
Line(10) = {5, 9};

Transfinite Curve {1, 3, 4, 6} = side + 1 Using Progression 1.2;
Transfinite Curve {2, 5} = fine + 1;
Transfinite Curve {7, 8, 9, 10} = high + 1 Using Progression 1.15;

Curve Loop(1) = {-1, 8, 4, -7};
Curve Loop(2) = {2, 9, -5, -8};
Curve Loop(3) = {3, 10, -6, -9};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Transfinite Surface {1, 2, 3};
Recombine Surface {1, 2, 3};

Physical Curve("arc", 1)        = {1, 2, 3};
Physical Curve("top", 2)        = {4, 5, 6};
Physical Curve("flanks", 3)     = {7, 10};
Physical Surface("cylinder", 4) = {1, 2, 3};

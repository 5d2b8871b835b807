// A molar across the row of teeth: two cusps and the fossa between them; the
// left cusp's tip lies at the origin [m], the tooth below. To be included by
// files that set these values.
Mesh.MshFileVersion = 2.2;

DefineConstant[
  inclination  = 35     // of all slopes to the occlusal plane [degrees]
  distance     = 0.006  // from cusp to cusp
  cusp_radius  = 0.0007 // of their tips
  fossa_radius = 0.0010 // of its bottom
  overhang     = 0.0025 // of the crown beyond each cusp
  height       = 0.007  // from the base to the tips
  fine_cell    = 0.0001 // size of cells along the cusps and the fossa
  coarse_cell  = 0.0008 // and at the base
];

a = inclination * Pi / 180;
r = cusp_radius;
q = fossa_radius;
m = distance / 2;
// Ends of the arcs, to either side of their middles.
rx = r * Sin(a);
ry = r * (1 - Cos(a));
qx = q * Sin(a);
qy = q * (1 - Cos(a));
depth = ry + qy + (m - rx - qx) * Tan(a);
edge  = ry + (overhang - rx) * Tan(a);

Point(1)  = {-overhang, -height, 0, coarse_cell};
Point(2)  = {distance + overhang, -height, 0, coarse_cell};
Point(3)  = {distance + overhang, -edge, 0, coarse_cell};
Point(4)  = {distance + rx, -ry, 0, fine_cell};
Point(5)  = {distance, 0, 0, fine_cell};
Point(6)  = {distance - rx, -ry, 0, fine_cell};
Point(7)  = {m + qx, -depth + qy, 0, fine_cell};
Point(8)  = {m, -depth, 0, fine_cell};
Point(9)  = {m - qx, -depth + qy, 0, fine_cell};
Point(10) = {rx, -ry, 0, fine_cell};
Point(11) = {0, 0, 0, fine_cell};
Point(12) = {-rx, -ry, 0, fine_cell};
Point(13) = {-overhang, -edge, 0, coarse_cell};
Point(14) = {distance, -r, 0, fine_cell};
Point(15) = {m, -depth + q, 0, fine_cell};
Point(16) = {0, -r, 0, fine_cell};

Line(1)    = {1, 2};
Line(2)    = {2, 3};
Line(3)    = {3, 4};
Circle(4)  = {4, 14, 5};
Circle(5)  = {5, 14, 6};
Line(6)    = {6, 7};
Circle(7)  = {7, 15, 8};
Circle(8)  = {8, 15, 9};
Line(9)    = {9, 10};
Circle(10) = {10, 16, 11};
Circle(11) = {11, 16, 12};
Line(12)   = {12, 13};
Line(13)   = {13, 1};
Curve Loop(1) = {1:13};
Plane Surface(1) = {1};
Mesh.Algorithm              = 6;
Mesh.RecombinationAlgorithm = 2; // quadrilaterals only
Recombine Surface {1};

Physical Curve("base", 1)    = {1};
Physical Curve("crown", 2)   = {3:12};
Physical Curve("sides", 3)   = {2, 13};
Physical Surface("tooth", 4) = {1};

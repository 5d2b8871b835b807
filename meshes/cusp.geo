// A single cusp with a rounded tip, which lies at the origin [m], the tooth
// below it; quadrilaterals, fine at the tip. As an upper tooth it is turned by
// 180 degrees.
//     gmsh -2 cusp.geo -o cusp.msh
// Another file may set these values and include this one.
Mesh.MshFileVersion = 2.2;

DefineConstant[
  inclination = 35     // of the flanks to the occlusal plane [degrees]
  tip_radius  = 0.0006
  width       = 0.012
  height      = 0.007  // from the base to the tip
  tip_cell    = 0.00005 // size of cells along the arc
  base_cell   = 0.0008 // and at the base
];

a = inclination * Pi / 180;
r = tip_radius;
// Where the arc becomes the flank, and where the flank ends.
tx = r * Sin(a);
ty = r * (Cos(a) - 1);
ey = ty - (width / 2 - tx) * Tan(a);

Point(1) = {0, -r, 0, tip_cell};
Point(2) = {0, 0, 0, tip_cell};
Point(3) = {-tx, ty, 0, tip_cell};
Point(4) = { tx, ty, 0, tip_cell};
Point(5) = {-width / 2, ey, 0, base_cell};
Point(6) = { width / 2, ey, 0, base_cell};
Point(7) = {-width / 2, -height, 0, base_cell};
Point(8) = { width / 2, -height, 0, base_cell};

Line(1)   = {7, 8};
Line(2)   = {8, 6};
Line(3)   = {6, 4};
Circle(4) = {4, 1, 2};
Circle(5) = {2, 1, 3};
Line(6)   = {3, 5};
Line(7)   = {5, 7};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7};
Plane Surface(1) = {1};
Mesh.Algorithm              = 6;
Mesh.RecombinationAlgorithm = 2; // quadrilaterals only
Recombine Surface {1};

Physical Curve("base", 1)    = {1};
Physical Curve("crown", 2)   = {3, 4, 5, 6};
Physical Curve("sides", 3)   = {2, 7};
Physical Surface("tooth", 4) = {1};

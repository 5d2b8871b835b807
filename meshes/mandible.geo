// A lower jaw with its first molar from the side, the mouth opening to the right
// [m]: the condyle's middle at the origin, the molar 60 mm in front of it, 35 mm
// below; the body of the bone 23 mm high. Quadrilaterals, fine at the crown.
//     gmsh -2 mandible.geo -o mandible.msh
Mesh.MshFileVersion = 2.2;

molar    = 0.060; // from the condyle
crown    = 0.035; // its top, below the condyle
tooth    = 0.0055; // half its width
neck     = 0.007; // height of the crown
body     = 0.023; // height of the bone below
head     = 0.005; // radius of the condyle
fine     = 0.0008;
coarse   = 0.0035;

top = -crown - neck;
low = top - body;

// The condyle and the neck behind it.
Point(1) = {0, 0, 0, 0.002};
Point(2) = {head, 0, 0, 0.002};
Point(3) = {0, head, 0, 0.002};
Point(4) = {-head, 0, 0, 0.002};
// Down the back of the ramus to the angle and along the lower edge to the chin.
Point(5) = {-0.006, -0.020, 0, coarse};
Point(6) = {-0.002, -0.048, 0, coarse};
Point(7) = {0.012, low + 0.001, 0, coarse};
Point(8) = {0.035, low, 0, coarse};
Point(9) = {0.075, low + 0.001, 0, coarse};
Point(10) = {0.089, low + 0.006, 0, coarse};
Point(11) = {0.090, top - 0.002, 0, coarse};
Point(12) = {0.084, top, 0, coarse};
// The crown of the molar, wider above its neck.
Point(13) = {molar + tooth - 0.0008, top, 0, 0.0015};
Point(14) = {molar + tooth, -crown - 0.003, 0, fine};
Point(15) = {molar + 0.0035, -crown, 0, fine};
Point(16) = {molar, -crown - 0.0012, 0, fine};
Point(17) = {molar - 0.0035, -crown, 0, fine};
Point(18) = {molar - tooth, -crown - 0.003, 0, fine};
Point(19) = {molar - tooth + 0.0008, top, 0, 0.0015};
// Up the front of the ramus, the coronoid process, the notch, the condyle.
Point(20) = {0.038, top, 0, coarse};
Point(21) = {0.030, -0.022, 0, coarse};
Point(22) = {0.027, -0.004, 0, 0.0025};
Point(23) = {0.022, -0.004, 0, 0.0025};
Point(24) = {0.014, -0.016, 0, 0.0025};
Point(25) = {0.008, -0.011, 0, 0.0025};

Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Spline(3) = {4, 5, 6, 7, 8};
Spline(4) = {8, 9, 10, 11, 12};
Line(5)   = {12, 13};
Spline(6) = {13, 14, 15, 16, 17, 18, 19};
Line(7)   = {19, 20};
Spline(8) = {20, 21, 22};
Line(9)   = {22, 23};
Spline(10) = {23, 24, 25, 2};
Curve Loop(1) = {1:10};
Plane Surface(1) = {1};
Mesh.Algorithm              = 6;
Mesh.RecombinationAlgorithm = 2; // quadrilaterals only
Recombine Surface {1};

Physical Curve("condyle", 1)   = {1, 2};
Physical Curve("crown", 2)     = {6};
Physical Curve("bone", 3)      = {3, 4, 5, 7, 8, 9, 10};
Physical Surface("mandible", 4) = {1};

// The upper tooth of a pair, as it lies on its crown's back: turned by 180
// degrees its cusps bite into fossae. In occlusion its left cusp, at the origin,
// stands in the lower tooth's fossa.
//     gmsh -2 molar_upper.geo -o molar_upper.msh
cusp_radius = 0.0009;
Include "molar.geo";

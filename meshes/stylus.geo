// The 45 degree cusp of a bench: flanks inclined by 45 degrees to the occlusal
// plane, a tip of 0.5 mm (assumed) at the origin [m].
//     gmsh -2 stylus.geo -o stylus.msh
inclination = 45;
tip_radius  = 0.0005;
width       = 0.010;
height      = 0.008;
tip_cell    = 0.00005;
base_cell   = 0.0008;
Include "cusp.geo";

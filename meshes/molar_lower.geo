// The lower tooth of a pair: a wide fossa between its cusps. The left cusp's
// tip lies at the origin, the fossa's bottom 3 mm to the right [m].
//     gmsh -2 molar_lower.geo -o molar_lower.msh
fossa_radius = 0.0014;
Include "molar.geo";

#include <morsel/scene/write_back.h>

#include <cstdlib>
#include <sstream>
#include <string>

namespace Morsel::Scene
{
  namespace
  {
    /// All digits that a number needs to be read back unchanged.
    std::string
    exact_text(const double value)
    {
      std::ostringstream text;
      text.precision(15);
      text << value;
      if (std::strtod(text.str().c_str(), nullptr) != value)
        {
          text.str("");
          text.precision(17);
          text << value;
        }
      return text.str();
    }


    std::string
    point_text(const dealii::Point<2> &p)
    {
      return exact_text(p[0]) + ", " + exact_text(p[1]);
    }


    void
    write_body(const ParticleBody &body, dealii::ParameterHandler &prm)
    {
      // Copies, since setting an entry sets the bound member, too.
      const Materials::MaterialParameters material = body.material;
      const Materials::DamageParameters   damage   = body.damage;
      const std::string                   mesh     = body.shape.mesh_file;
      prm.enter_subsection("Body " + body.name);
      prm.enter_subsection("Shape");
      prm.set("Mesh file", mesh);
      prm.leave_subsection();
      prm.enter_subsection("Material");
      prm.set("Density", exact_text(material.density));
      prm.set("Young's modulus", exact_text(material.youngs_modulus));
      prm.set("Poisson's ratio", exact_text(material.poissons_ratio));
      prm.set("Toughness", exact_text(material.toughness));
      prm.set("Compressive strength",
              exact_text(material.compressive_strength));
      prm.leave_subsection();
      prm.enter_subsection("Damage");
      prm.set("Flaws", damage.flaws);
      prm.set("Correlation length", exact_text(damage.correlation_length));
      prm.set("Weibull modulus", exact_text(damage.weibull_modulus));
      prm.set("Strength ratio", exact_text(damage.strength_ratio));
      prm.set("Fracture energy", exact_text(damage.fracture_energy));
      prm.set("Threshold factor", exact_text(damage.threshold_factor));
      prm.leave_subsection();
      prm.leave_subsection();
    }


    void
    write_plate(const PlateBody &body, dealii::ParameterHandler &prm)
    {
      const std::string table = body.motion.table_file;
      const PlateShape  shape = body.shape;
      prm.enter_subsection("Body " + body.name);
      if (!table.empty())
        {
          prm.enter_subsection("Motion");
          prm.set("Table file", table);
          prm.leave_subsection();
        }
      if (shape.is_mesh())
        {
          prm.enter_subsection("Shape");
          prm.set("Lower corner", point_text(shape.lower_corner));
          prm.set("Upper corner", point_text(shape.upper_corner));
          prm.set("Mesh file", shape.mesh_file);
          prm.leave_subsection();
        }
      prm.leave_subsection();
    }
  } // namespace


  void
  write_back(const Scene &scene, dealii::ParameterHandler &prm)
  {
    const Rectangle domain = scene.domain;
    prm.set("Name", std::string(scene.name));
    prm.enter_subsection("Domain");
    prm.set("Lower corner", point_text(domain.lower_corner));
    prm.set("Upper corner", point_text(domain.upper_corner));
    prm.leave_subsection();

    for (const ParticleBody &body : scene.particle_bodies)
      write_body(body, prm);
    for (const PlateBody &body : scene.plate_bodies)
      write_plate(body, prm);

    std::string list;
    for (const ContactPair &pair : scene.contact_pairs)
      list += (list.empty() ? "" : ", ") + pair.food + ":" + pair.plate;
    prm.enter_subsection("Contact");
    prm.set("Pairs", list);
    prm.leave_subsection();
  }
} // namespace Morsel::Scene

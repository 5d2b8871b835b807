#ifndef morsel_materials_catalogue_h
#define morsel_materials_catalogue_h

#include <morsel/materials/parameters.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace Morsel::Materials
{
  /// Damage parameters that a calibration found for a material, and the scene
  /// that made them. What it does not say is left to the program's defaults.
  struct CatalogueDamage
  {
    std::optional<double>      threshold_factor;   ///< c [1]
    std::optional<double>      weibull_modulus;    ///< m [1]
    std::optional<double>      strength_ratio;     ///< f_c/f_t [1]
    std::optional<double>      fracture_energy;    ///< G_c [J/m^2]
    std::optional<std::string> flaws;              ///< as Damage/Flaws
    std::optional<double>      correlation_length; ///< l [m]
    std::string                scene;
    unsigned int               particles_across = 0;
    unsigned int               seeds            = 0;
  };


  /// The object "damage" of a catalogue's entry.
  nlohmann::ordered_json
  as_json(const CatalogueDamage &damage);


  /// One food or rock of the catalogue. A value of 0 is not known.
  struct CatalogueEntry
  {
    std::string                    name;
    std::string                    kind; ///< "food" or "rock"
    double                         density              = 0.; ///< [kg/m^3]
    double                         youngs_modulus       = 0.; ///< [Pa]
    double                         poissons_ratio       = 0.; ///< [1]
    double                         toughness            = 0.; ///< U [J/m^3]
    double                         fracture_energy      = 0.; ///< R [J/m^2]
    double                         compressive_strength = 0.; ///< f_c [Pa]
    std::string                    source;  ///< where the values come from
    std::vector<std::string>       assumed; ///< values that were not measured
    std::optional<CatalogueDamage> damage;  ///< where it has been calibrated
  };


  /// The foods and rocks that the program ships as data.
  class Catalogue
  {
  public:
    /// Reads a catalogue.
    /// @throw FileError if the file is missing or is not a catalogue.
    explicit Catalogue(const std::string &file_name);

    /// The shipped catalogue's file: where the program was built, or else
    /// beside the installed program (share/morsel).
    /// @throw FileError if it is in neither place.
    static std::string
    shipped_file();

    const std::vector<CatalogueEntry> &
    entries() const;

    /// The names of all entries.
    std::vector<std::string>
    names() const;

    /// The entry of this name, or nullptr.
    const CatalogueEntry *
    find(const std::string &name) const;

  private:
    std::vector<CatalogueEntry> materials;
  };


  /// Fills what is not given (0; Poisson's ratio -1) from a catalogue entry.
  void
  complete(MaterialParameters &material, const CatalogueEntry &entry);


  /// Fills what is left open from a catalogue entry or, where that knows
  /// nothing, with the program's defaults. Fracture energy and threshold
  /// factor were found with energy softening: other growths do not take them.
  /// @param entry nullptr: the defaults
  void
  complete(DamageParameters &damage, const CatalogueEntry *entry);


  /// Derives the compressive strength sqrt(2 E U) where none is given, but a
  /// toughness.
  void
  derive_strength(MaterialParameters &material);
} // namespace Morsel::Materials

#endif

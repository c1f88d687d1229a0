#include "io/suggestion.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <numeric>

#include "base/error.h"
#include "io/keys.h"

namespace whine {
namespace {

// Words without unit and without '_', in small letters.
struct Synonym {
  const char* words;  // blank between
  const char* key;    // "": there is none
  const char* note = "";
};

constexpr Synonym kSynonyms[] = {
    {"helixangle helix beta spiralangle", "helix_angle_deg"},
    {"frictioncoefficient coefficientoffriction friction cof", "coefficient"},
    {"bearingstiffness shaftstiffness supportstiffness", "stiffness_N_um"},
    {"torquenmm momentnmm inputtorquenmm", "torque_Nm", "1 N m is 1000 N mm"},
    {"leadcrowning helixcrowning", "lead_crowning_um", "in [gear.<name>.modification]"},
    {"leadslope helixslope", "lead_slope_um", "in [gear.<name>.modification]"},
    {"z n toothcount numberofteeth noofteeth numteeth nteeth teethnumber teethcount", "teeth"},
    {"m mn mt normalmodule transversemodule modul", "module_mm"},
    {"diametralpitch dp", "module_mm", "25.4 over the diametral pitch"},
    {"alpha alphan normalpressureangle pressure flankangle", "pressure_angle_deg"},
    {"x shift profileshift shiftcoefficient profileshiftcoefficient profileshiftfactor addendummodification",
     "profile_shift", "in modules"},
    {"width b thickness breadth gearwidth toothwidth facewidth", "face_width_mm"},
    {"bore borediameter hubdiameter shaftdiameter innerdiameter holediameter", "bore_radius_mm",
     "half of the diameter"},
    {"hubradius shaftradius innerradius holeradius", "bore_radius_mm"},
    {"webthickness web webwidth websthickness", "bore_radius_mm",
     "there are no webs: the radius inside which the gear is as good as rigid, that of the web's root or of the shaft"},
    {"rimthickness rimwidth ringthickness", "rim_outer_radius_mm",
     "of an internal gear: root radius plus the thickness; of an external one bore_radius_mm: root radius less the thickness"},
    {"hubwidth hublength keyway spline shaft shaftname onshaft", "",
     "gears have one width and stand alone: those that share a shaft are not computed; take the line out"},
    {"undercut undercutting cutterprotuberance protuberance protuberanceamount", "",
     "what the rack cuts follows from teeth, profile_shift, dedendum and rack_tip_radius; take the line out"},
    {"chamfer tipchamfer tipchamferwidth tiprounding edgebreak", "tip_diameter_mm",
     "the diameter at which the flank ends"},
    {"tipclearance clearance bottomclearance", "dedendum",
     "in modules: the mate's addendum plus the clearance"},
    {"basetangentlength spanmeasurement spanwidth wk md dimensionoverpins dimensionoverballs toothwidthdeviation",
     "tooth_thinning_mm", "the arc taken off at the pitch circle, for backlash"},
    {"tooththickness sn circulartooththickness", "tooth_thinning_mm",
     "module (pi / 2 + 2 profile_shift tan(pressure_angle)) less the tooth thickness"},
    {"power inputpower", "torque_Nm", "power over the angular speed of the driver"},
    {"rim rimradius ringradius outerrimradius ringouterradius", "rim_outer_radius_mm"},
    {"rimdiameter ringdiameter ringouterdiameter", "rim_outer_radius_mm", "half of the diameter"},
    {"ring ringgear annulus internalgear internalteeth hollow", "internal", "true"},
    {"da outsidediameter outerdiameter addendumdiameter tipcirclediameter headdiameter", "tip_diameter_mm"},
    {"ra tipradius outsideradius outerradius addendumradius", "tip_diameter_mm", "twice the radius"},
    {"df dedendumdiameter rootcirclediameter footdiameter", "root_diameter_mm"},
    {"rf rootradius dedendumradius", "root_diameter_mm", "twice the radius"},
    {"ha addendum addendumcoefficient addendumfactor", "addendum", "in modules"},
    {"hf dedendum dedendumcoefficient dedendumfactor", "dedendum", "in modules"},
    {"filletradius rootfillet rootfilletradius cuttertipradius tooltipradius hobtipradius racktipradius toolroundness rhof rhoap rhoa0 rhofp",
     "rack_tip_radius", "in modules"},
    {"backlash thinning tooththicknessallowance", "tooth_thinning_mm",
     "on each gear; the backlash is the sum of both, and what the centre distance gives"},
    {"inertiakgmm2 totalinertiakgmm2 momentofinertiakgmm2", "total_inertia_kgm2", "1 kg mm2 is 1e-6 kg m2"},
    {"inertia momentofinertia massmoment totalinertia", "total_inertia_kgm2"},
    {"a centredistance centerdistance axisdistance distance centres", "centre_distance_mm"},
    {"e young youngs youngmodulus elasticmodulus modulusofelasticity", "youngs_modulus_GPa"},
    {"nu poisson poissonsratio poissonratio", "poisson_ratio"},
    {"rho massdensity", "density_kgm3"},
    {"t moment load inputtorque", "torque_Nm", "of the driver"},
    {"rpm speed speeds shaftspeed rotationspeed inputspeed", "mesh_frequency_Hz",
     "teeth of the driver times its rpm, over 60"},
    {"zeta dampingratio damping", "rayleigh_stiffness_s",
     "`make calibrate DAMPING=0.05` finds the one that means a damping ratio of 0.05"},
    {"elementsize meshsize element", "element_mm"},
    {"relief tiprelief tiprelieved ca ct", "tip_relief_um"},
    {"rootrelief cf", "root_relief_um"},
    {"crowning crown profilecrowning calpha", "crowning_um"},
    {"runout eccentricity", "eccentricity_um", "half of the run-out"},
    {"quality grade accuracygrade accuracyclass qualityclass", "iso_class"},
    {"pinion input drivinggear", "driver"},
    {"wheel gear output drivengear", "driven"},
};

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      const bool same = std::tolower(a[i - 1]) == std::tolower(b[j - 1]);
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (same ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

// The first of those at the least distance; the distance of no word is `least`.
std::string nearest_within(const std::string& word, const std::vector<std::string>& known,
                           std::ptrdiff_t& least) {
  std::string best;
  least = static_cast<std::ptrdiff_t>(word.size() / 2 + 2);
  for (const auto& candidate : known) {
    // Words that both begin with bring them nearer: bore_mm is meant for bore_radius_mm, not for module_mm.
    const auto apart = std::mismatch(word.begin(), word.end(), candidate.begin(), candidate.end()).first;
    const std::size_t shared = std::string(word.begin(), apart).rfind('_') + 1;
    const auto distance =
        static_cast<std::ptrdiff_t>(edit_distance(word, candidate)) - static_cast<std::ptrdiff_t>(shared);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

// Small letters without '_', '-' and a unit behind.
std::string stem_of(const std::string& word) {
  static const char* const kUnits[] = {"_mm",    "_um",      "_m",    "_cm",  "_in",  "_inch", "_deg",
                                       "_rad",   "_nm",      "_hz",   "_khz", "_rpm", "_gpa",  "_mpa",
                                       "_pa",    "_kgm2",    "_kgm3", "_s",   "_n",   "_kg",   "_g",
                                       "_per_s", "_n_per_m", "_n_um", "_ns_m"};
  std::string stem;
  for (const char c : word) stem += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const std::string unit : kUnits)
    if (stem.size() > unit.size() && stem.ends_with(unit)) {
      stem.resize(stem.size() - unit.size());
      break;
    }
  std::erase_if(stem, [](char c) { return c == '_' || c == '-' || c == ' '; });
  return stem;
}

const Synonym* synonym_of(const std::string& word) {
  const std::string stem = " " + stem_of(word) + " ";
  for (const Synonym& synonym : kSynonyms)
    if ((" " + std::string(synonym.words) + " ").find(stem) != std::string::npos) return &synonym;
  return nullptr;
}

const Key* key_called(const std::string& name) {
  for (const Key& key : scene_keys())
    if (name == key.name) return &key;
  return nullptr;
}

std::string section_words(const Key& key) {
  const std::string section(key.section);
  return (section.empty() ? "the top of the file, above all sections" : heading_of(key)) +
         (section == "train_mesh"   ? " of a system"
          : section == "rigid_gear" ? " of a system with body = \"rigid\""
                                    : "");
}

// "2,5": "2.5"; "" if the word is not a number with a decimal comma.
std::string without_decimal_comma(const std::string& word) {
  const auto digit = [&](std::size_t i) {
    return i < word.size() && std::isdigit(static_cast<unsigned char>(word[i]));
  };
  const auto comma = word.find(',');
  if (comma == std::string::npos || comma == 0 || !digit(comma - 1) || !digit(comma + 1)) return "";
  std::string out = word;
  out[comma] = '.';
  char* end = nullptr;
  std::strtod(out.c_str(), &end);
  return *end ? "" : out;
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  std::ptrdiff_t least = 0;
  return nearest_within(word, known, least);
}

const Key* meant_key(const std::string& word, std::string& note) {
  note.clear();
  if (const Synonym* synonym = synonym_of(word)) {
    note = synonym->note;
    return key_called(synonym->key);
  }
  std::vector<std::string> all;
  for (const Key& key : scene_keys()) all.push_back(key.name);
  return key_called(nearest(word, all));
}

std::string advice_on_key(const std::string& word, const std::string& section,
                          const std::vector<std::string>& known) {
  const Synonym* synonym = synonym_of(word);
  const Key* const meant = synonym ? key_called(synonym->key) : nullptr;
  // What another section calls by this word may have another name here: the inertia of a carrier and that of a gear.
  constexpr std::ptrdiff_t kNear = 2;
  std::ptrdiff_t here = 0, anywhere = 0;
  const std::string near = nearest_within(word, known, here);
  if (!meant || meant->section != section)
    for (const Key& key : scene_keys())
      if (word == key.name)
        return here <= kNear
                   ? text("; did you mean '", near, "'? '", word, "' belongs into ", section_words(key))
                   : text("; it belongs into ", section_words(key));
  if (synonym) {
    const Key* key = meant;
    if (!key) return text(": ", synonym->note);
    const std::string there = key->section == section ? "" : " of " + section_words(*key);
    return text("; did you mean '", key->name, "'", there,
                *synonym->note ? text(" (", synonym->note, ")") : "", "?");
  }
  std::vector<std::string> all;
  for (const Key& key : scene_keys()) all.push_back(key.name);
  const std::string elsewhere = nearest_within(word, all, anywhere);
  const Key* key = key_called(elsewhere);
  if (key && key->section != section && (near.empty() || anywhere < here))
    return text("; did you mean '", elsewhere, "' of ", section_words(*key), "?");
  return near.empty() ? "" : text("; did you mean '", near, "'?");
}

std::string renamed(const std::string& word) {
  constexpr std::array<std::array<const char*, 2>, 4> kRenamed{{{"lagged", "relaxed"},
                                                                {"march", "integrate"},
                                                                {"answers", "quantities"},
                                                                {"refusals", "outside_model"}}};
  for (const auto& [before, now] : kRenamed)
    if (word == before) return now;
  return "";
}

std::string number_advice(const std::string& word) {
  const std::string point = without_decimal_comma(word), number = point.empty() ? word : point;
  char* end = nullptr;
  std::strtod(number.c_str(), &end);
  if (end == number.c_str() || *end) return "";
  return text("; write ", number, point.empty() ? "" : ", with a decimal point and", " without quotes");
}

std::string value_advice(const std::string& line) {
  char quote = 0;
  int depth = 0;  // within brackets a comma parts two numbers
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      break;
    } else if (c == '[' || c == ']') {
      depth += c == '[' ? 1 : -1;
    } else if (c == '=' && depth == 0) {
      const auto begin = line.find_first_not_of(" \t", i + 1);
      if (begin == std::string::npos) break;
      std::string word = line.substr(begin, line.find_first_of(" \t\r}#", begin) - begin);
      if (word.ends_with(',')) word.pop_back();  // in { from = 600,5, to = 700 }
      if (const std::string point = without_decimal_comma(word); !point.empty())
        return text("; numbers have a decimal point: ", point, ", not ", word);
      if (std::isalpha(static_cast<unsigned char>(word[0])) && word != "true" && word != "false")
        return text("; text stands in quotes: \"", word, "\"");
    }
  }
  return "";
}

}  // namespace whine

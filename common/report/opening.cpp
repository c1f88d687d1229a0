#include "report/opening.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/format.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/measured_errors.h"
#include "report/report_content.h"

namespace whine {
namespace {

constexpr double kLossLimit = 1.7;  // swing of the stiffness over damping ratio above which contact is lost
constexpr size_t kMostNatural = 3;  // that are named

std::string micrometres(const Spread& s) {
  const std::string least = significant(s.least * kMicro, 3), most = significant(s.most * kMicro, 3);
  if (s.error >= 0 && s.least == s.most)
    return told(s.most * kMicro, s.error * kMicro, kToldDigits).words() + " µm";
  return (least == most ? most : least + " to " + most) + " µm";
}

std::string rows_of_speeds(const TurningMember& member, const std::vector<double>& speeds) {
  std::vector<SpeedRange> single;
  single.reserve(speeds.size());
  for (const double f : speeds) single.push_back({f, f});
  return speed_words(member, single);
}

std::string natural_words(const CriticalSpeeds::Natural& natural) {
  return (natural.error < 0 ? fixed(natural.frequency, 0)
                            : told(natural.frequency, natural.error, kToldDigits).words()) +
         " Hz";
}

bool within(double f, const std::optional<SpeedRange>& speeds) {
  return !speeds || (f >= speeds->from && f <= speeds->to);
}

}  // namespace

std::string excitation_line(const std::string& load, const std::vector<MeshExcitation>& meshes) {
  if (meshes.empty()) return "The gears are rigid: no transmission error is computed.";
  std::vector<std::string> parts;
  parts.reserve(meshes.size());
  for (const MeshExcitation& m : meshes)
    parts.push_back(text(micrometres(m.peak_to_peak), m.mesh.empty() ? "" : " of " + m.mesh, " (first order ",
                         micrometres(m.first_order), ")"));
  return text("At ", load, " the transmission error swings from peak to peak by ", listed(parts), ".");
}

std::string critical_speed_line(const CriticalSpeeds& c) {
  std::vector<std::string> met;
  for (const CriticalSpeeds::Natural& natural : c.natural) {
    std::vector<std::string> orders;
    for (int order = 1; order <= kOrders; ++order)
      if (const double f = natural.frequency / order;
          natural.excited[static_cast<size_t>(order - 1)] && within(f, c.speeds))
        orders.push_back(text("order ", order, " at ", speed_words(c.member, f)));
    // The largest vibration may stand where no speed is computed.
    const std::string outside =
        natural.excited[0] && !within(natural.frequency, c.speeds)
            ? text(", and by order 1 outside the speeds, at ", speed_words(c.member, natural.frequency))
            : "";
    if (!orders.empty() && met.size() < kMostNatural)
      met.push_back(
          text(natural.name, " (", natural_words(natural), ") is met by ", listed(orders), outside));
  }
  const std::string of = c.member.turns > 0 ? text(" Speeds are those of ", c.member.name,
                                                   c.member.with.empty() ? "" : ", " + c.member.with, ".")
                                            : "";
  std::string out;
  for (size_t i = 0; i < met.size(); ++i) out += (i == 0 ? "" : "; ") + met[i];
  if (out.empty())
    out = c.natural.empty()
              ? "no natural frequency is computed"
              : text("no order up to ", kOrders, " meets ",
                     c.natural.size() == 1 ? text(c.natural[0].name, " (", natural_words(c.natural[0]), ")")
                                           : "a natural frequency",
                     " within ", c.speeds ? speed_words(c.member, {*c.speeds}) : "the speeds");
  out[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(out[0])));
  if (c.speeds)
    out += c.peaks.empty() ? "; the computed vibration has no peak within the speeds"
                           : "; the computed vibration peaks at " + rows_of_speeds(c.member, c.peaks);
  return out + "." + of;
}

namespace {

std::string from_rest_words(const Parting& p) {
  const Parting::Sweep& up = *p.rising;
  if (up.apart.empty())
    return p.falling
               ? " A drive that starts from rest keeps contact; one that comes from a higher speed does not."
               : "";
  const double first = up.apart.front().from;
  const bool jumps = std::any_of(up.jumps.begin(), up.jumps.end(),
                                 [&](double f) { return std::abs(f - first) < 0.05 * first; });
  std::string out = text(" A drive that starts from rest gets there", up.apart.size() > 1 ? " first" : "",
                         " at ", speed_words(p.member, first), jumps ? ", by a jump" : "");
  if (!p.only_falling.empty())
    out += "; at " + speed_words(p.member, p.only_falling) + " only one that comes from a higher speed does";
  return out + ".";
}

}  // namespace

std::string parting_line(const Parting& p) {
  if (!p.speeds || (!p.rising && !p.falling))
    return "No motion is computed: whether teeth part is not known.";
  std::string out = text("From ", speed_words(p.member, {*p.speeds}), " ");
  const bool rising = p.rising && !p.rising->apart.empty(), falling = p.falling && !p.falling->apart.empty();
  if (!rising && !falling) {
    out += text("teeth do not part, with speed ", p.rising && p.falling ? "rising or falling."
                                                  : p.rising            ? "rising."
                                                                        : "falling.");
  } else {
    std::vector<std::string> ways;
    if (rising) ways.push_back("with speed rising at " + speed_words(p.member, p.rising->apart));
    if (falling) ways.push_back("with speed falling at " + speed_words(p.member, p.falling->apart));
    out += text("teeth part", p.meshes.empty() ? "" : " (" + p.meshes + ")", ": ");
    for (size_t i = 0; i < ways.size(); ++i) out += (i == 0 ? "" : "; ") + ways[i];
    out += ".";
    if (p.rising) out += from_rest_words(p);
  }
  if (!p.parts_at.empty()) out += " At " + listed(p.parts_at) + " teeth part, too.";
  if (!p.holds_at.empty())
    out += text(" At ", listed(p.holds_at), rising || falling ? " they do not." : " neither.");
  return out;
}

std::string dynamic_factor_line(const TurningMember& member, const std::vector<DynamicFactor>& meshes,
                                const std::string& no_standard) {
  if (meshes.empty()) return "No motion is computed, so there is no dynamic factor.";
  std::vector<std::string> parts;
  bool standard = false;
  for (const DynamicFactor& m : meshes) {
    standard = standard || m.standard;
    parts.push_back(text(
        m.error < 0 ? fixed(m.factor, 2) : told(m.factor, m.error, kToldDigits).words(),
        " times its mean at rest", m.mesh.empty() ? "" : " in " + m.mesh, ", at ", speed_words(member, m.at),
        m.standard ? text(", where K_v of ISO 6336-1 (method B, gears without deviations) is ",
                          fixed(*m.standard, 2))
                   : ""));
  }
  return text(
      "The mesh force reaches ", listed(parts), ".",
      standard || no_standard.empty() ? "" : " K_v of ISO 6336-1 has no value here: " + no_standard + ".");
}

std::string advice_line(const Advice& a) {
  std::vector<std::string> out;
  for (const Advice::Relief& relief : a.relief)
    out.push_back(text("Relieve the tips of ", relief.gears, " by about ", fixed(relief.amount * kMicro, 0),
                       " µm, the deflection under this load: their edges carry up to ",
                       fixed(relief.edge_load, 0), " N."));
  if (!a.avoid.empty())
    out.push_back(text("Keep the speed", a.member.turns > 0 ? " of " + a.member.name : "", " out of ",
                       speed_words(a.member, a.avoid),
                       a.parts ? ", where teeth part." : ", where the vibration is largest."));
  if (a.parts && a.stiffness_swing && a.damping_ratio)
    out.push_back(text("Contact is lost where the first harmonic of the mesh stiffness over its mean, ",
                       fixed(*a.stiffness_swing * kPercent, 1), " %, is above about ", shown(kLossLimit, 2),
                       " times the damping ratio, ", fixed(kLossLimit * *a.damping_ratio * kPercent, 1),
                       " % here: lower the one by relief, contact ratio or torque, or raise the other."));
  out.insert(out.end(), a.more.begin(), a.more.end());
  if (out.empty()) {
    const char *edges = a.edges ? "no tip edge carries load" : "",
               *peaks = a.moves ? "the vibration has no peak within the speeds" : "";
    return text("Nothing stands out", a.edges || a.moves ? ": " : "", edges,
                a.edges && a.moves ? ", and " : "", peaks, ".", a.moves ? "" : " No motion is computed.");
  }
  std::string words;
  for (const std::string& sentence : out) words += (words.empty() ? "" : " ") + sentence;
  return words;
}

std::string opening_html(const std::vector<std::string>& lines, const std::string& picture) {
  static constexpr std::array<const char*, 5> kWord{"Excitation", "Critical speeds", "Contact",
                                                    "Dynamic factor", "What to change"};
  std::string items;
  for (size_t i = 0; i < std::min(lines.size(), kWord.size()); ++i)
    items += html::tagged("li", text("<strong>", kWord[i], ".</strong> ", html::escaped(lines[i]))) + "\n";
  return picture + html::tagged("ol class=\"opening\"", "\n" + items) + "\n";
}

}  // namespace whine

// What goals and stages do not take of a scene: one table of reasons, one check, one form of message, and the matrix on the page of studies.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "model/gear.h"
#include "model/scene.h"

namespace whine {

// What a scene is, of which it is one, and what it has.
enum class Trait {
  pair,
  train,
  pair_in_slices,
  train_in_slices,
  pair_of_bodies,  // in three dimensions
  train_of_bodies,
  rigid_gears,
  one_slice,
  no_speeds,
  no_planets,
  no_friction,
  no_bearings,
  no_errors,
  no_crack,
  like_teeth,
  unlike_pair,  // of which some teeth differ or are cracked
  differing,
  cracked,
  friction,
  bearings,
  internal,
  plane_stress,
  full_body,
  lines
};

// Traits, and where the scene says so: "[gear.pinion.crack]"; "" where nothing is to be said.
using Traits = std::vector<std::pair<Trait, std::string>>;
// Of two gears in mesh, of which `level` is one slice, slices or bodies.
Traits traits(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven,
              WidthModel level = WidthModel::one);
// Of levels of body and contact; in motion and at a fixed phase some are not taken.
Traits traits(const Fidelity& fidelity);
bool has(const Traits& of, Trait trait);
// What of a pair one slice over the face does not hold, in words: "[gear.pinion] is helical (helix_angle_deg = 20)"; "": nothing.
std::string face_words(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven);

// Of the first trait that a goal of make or a stage ("harris-map", "motion") does not take: "rigid gears: they have natural modes
// alone"; "": it takes them all. A goal that is not known is of pairs in one slice.
std::string not_taken(const std::string& feature, const Traits& of);
// The same with the goal before it and the remedy behind: "static does not take rigid gears: ...; write ..."
std::string refusal(const std::string& feature, const Traits& of);
// Throws Error(input) of it.
void require_able(const std::string& feature, const Traits& of);
// Goals of make, in the order in which messages offer them.
const std::vector<std::string>& known_goals();
// A table in Markdown: what each goal or stage takes of each kind of scene, and what else it does not take.
std::string capability_table();

}  // namespace whine

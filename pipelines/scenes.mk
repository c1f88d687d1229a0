# Scenes: which scene files the goals need, and what they tell make.
#
# gear-scene checks a scene and writes the parameter slices that stages depend on (out/S/params/*.toml), the
# keys of each distinct gear (out/bodies/<hash>/body.toml), the links out/S/<gear>, and a fragment of make:
#   SCENE_S_GEARS, SCENE_S_DRIVER, SCENE_S_DRIVEN, SCENE_S_BODY_<gear>, SCENE_S_TORQUES, SCENE_S_REFERENCE_TORQUE, BODIES.
# Make remakes a fragment before anything else, under -n as well (gear-scene itself is then compiled, too). This
# happens in every run and costs milliseconds: times cannot tell a scene of the same name in another folder, one that
# went back in time, or a deleted slice. All that it writes keeps its time if its content stays.

# SCENE: the user's scene; out/<its stem>/ is made from it. Without it `static`, `fig05` ... are of the paper's scene.
scene_stem := $(basename $(notdir $(SCENE)))
ifneq ($(words $(SCENE)),0)
  $(if $(filter-out 1,$(words $(SCENE))),$(error SCENE=$(SCENE): make cannot handle blanks in a path; rename the file))
  $(if $(wildcard $(SCENE)),,$(error SCENE=$(SCENE): there is no such file))
  $(if $(filter %.toml,$(SCENE)),,$(error SCENE=$(SCENE): a scene is a .toml file))
  $(if $(filter figures bodies,$(scene_stem)),$(error SCENE=$(SCENE): out/$(scene_stem) has another use; rename the file))
endif
own_scene := $(or $(scene_stem),$(paper_scene))
scene_file = $(if $(filter $(scene_stem),$1),$(SCENE),data/scenes/$1.toml)

path_goals := $(filter out/%,$(goals))
scenes := $(sort \
  $(if $(filter mesh reduce static impact calibrate sweep lumped out/bodies/%,$(goals)),$(own_scene)) \
  $(if $(filter $(figures) table1 figures,$(goals)),$(if $(SCENE),$(own_scene),$(paper_scenes))) \
  $(if $(filter scorecard out/figures/%,$(goals)),$(paper_scenes)) \
  $(if $(filter bench work-precision,$(goals)),$(paper_scene)) \
  $(foreach g,$(filter-out out/figures/% out/bodies/%,$(path_goals)),$(word 2,$(subst /, ,$g))))

$(foreach s,$(scenes),$(if $(wildcard $(call scene_file,$s)),,\
  $(error out/$s: there is no data/scenes/$s.toml; for a scene elsewhere say SCENE=path/to/$s.toml)))

scene_fragments := $(scenes:%=$(B)/scenes/%.mk)
# An empty fragment to start from, because make complains of an included file that it could not remake.
$(foreach f,$(filter-out $(wildcard $(scene_fragments)),$(scene_fragments)),$(shell mkdir -p $(dir $f) && touch $f))

$(scene_fragments): $(B)/scenes/%.mk: $(B)/bin/gear-scene FORCE
	@said=$$($< --scene $(call scene_file,$*) --output $@.new --out out 2>&1) || { status=$$?; echo "$$said" >&2; exit $$status; }; \
	if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; echo "$$said" >&2; fi

include $(scene_fragments)

# Scenes: which scene files the goals need, and what they tell make.
#
# gear-scene checks a scene, rejects goals that it cannot reach, and writes the stage parameters that stages depend on (out/S/params/*.toml),
# the keys of each distinct gear (out/bodies/<hash>/body.toml), the links out/S/<gear>, and a fragment of make, in which
# common/io/scene_fragment.h says what stands: SCENE_S_KIND, SCENE_S_TORQUES, ..., BODIES.
# Make remakes a fragment before anything else, under -n as well (gear-scene itself is then compiled, too). This
# happens in every run and costs milliseconds: times cannot tell a scene of the same name in another folder, one that
# went back in time, or deleted stage parameters. All that it writes keeps its time if its content stays.

# SCENE: the user's scene; out/<its stem>/ is made from it. Without it `static`, `fig05` ... are of the paper's scene.
scene_stem := $(basename $(notdir $(SCENE)))
own_scene := $(or $(scene_stem),$(paper_scene))
# SCENES: two to six for `compare`, the first is what the others are compared with. Or STUDY: the two variants that it marks, as
# scenes of their own.
comparing := $(filter compare,$(goals))
compared_files := $(if $(comparing),$(SCENES))
study_designs := $(if $(SCENES),,$(if $(comparing),$(foreach w,first second,$(basename $(notdir $(STUDY)))-$w)))
design_folder := out/studies/$(basename $(notdir $(STUDY)))/compare
compared := $(or $(study_designs),$(foreach f,$(compared_files),$(basename $(notdir $f))))

# Variants for `sensitivity`: name:key=value (more keys after commas) is the scene <own scene>-<name>. Those listed are
# what P2000 leaves open, about its scene; half of the damping from mass is 955 1/s at 5 % and 3040 Hz.
VARIANTS ?= bore35:bore_radius_mm=35 bore45:bore_radius_mm=45 dedendum140:dedendum=1.4 dedendum160:dedendum=1.6 \
  fillet05:rack_tip_radius=0.05 fillet20:rack_tip_radius=0.2 poisson27:poisson_ratio=0.27 poisson33:poisson_ratio=0.33 \
  strain:plane=strain inertia139:total_inertia_kgm2=0.0139 inertia157:total_inertia_kgm2=0.0157 \
  mass955:rayleigh_mass_per_s=955 depth025:undamped_depth_mm=0.25 depth100:undamped_depth_mm=1.0 \
  corner_1deg:corner_contact=1 corner_off:corner_contact=false corner_off_mass955:corner_contact=false,rayleigh_mass_per_s=955
# Finer than the scene, of 8 strips and 61 modes, for `bifurcations`.
halved_step = $(shell awk -F '[= ]+' '$$1 == "steps_per_period" { steps = $$2 } $$1 == "min_sample_rate_kHz" { rate = $$2 } \
  END { printf "steps_per_period=%d,min_sample_rate_kHz=%g", 2 * (steps ? steps : 128), 2 * (rate ? rate : 250) }' $(call quoted,$(or $(SCENE),data/scenes/$(own_scene).toml)))
BIFURCATION_VARIANTS := $(if $(filter bifurcations,$(goals)),halfstep:$(halved_step) strips16:strips=16 modes122:modes=122)
scenes_of = $(foreach v,$1,$(own_scene)-$(firstword $(subst :, ,$v)))
variant_scenes := $(call scenes_of,$(VARIANTS))
bifurcation_scenes := $(call scenes_of,$(BIFURCATION_VARIANTS))
# $(call changes,scene): of a variant
changes = $(subst $(,), ,$(foreach v,$(VARIANTS) $(BIFURCATION_VARIANTS),$(if $(filter $(call scenes_of,$v),$1),$(lastword $(subst :, ,$v)))))

scene_file = $(or $(if $(filter $1,$(study_designs)),$(design_folder)/$1.toml),$(firstword $(foreach f,$(compared_files),$(if $(filter $1,$(basename $(notdir $f))),$f))),\
  $(if $(filter $(scene_stem),$1),$(SCENE)),$(if $(filter $1,$(variant_scenes) $(bifurcation_scenes)),out/$(own_scene)/variants/$1.toml),data/scenes/$1.toml)

# of SCENE, or of the paper's; of a system
pair_goals := mesh reduce static loaded impact calibrate sweep histories sound runup lumped branches jump-map fold-curves sensitivity harris-map report teeth export
system_goals := modes mode-shapes
path_goals := $(filter out/%,$(goals))
# $(call of_goals,goals,scenes): SCENE, else these
of_goals = $(if $(filter $1,$(goals)),$(if $(SCENE),$(own_scene),$2))
drawn_of_scene = $(call of_goals,$1 out/figures/$1%,$2)
scenes := $(sort $(compared) $(call of_goals,$(pair_goals) jump-folds bifurcations out/bodies/%,$(paper_scene)) $(if $(filter bifurcations,$(goals)),$(bifurcation_scenes)) \
  $(if $(filter sensitivity out/figures/sensitivity%,$(goals)),$(variant_scenes)) $(if $(filter scorecard docs out/figures/%,$(goals)),$(paper_scenes)) \
  $(call of_goals,$(figures) table1 figures,$(shown_scenes)) $(call of_goals,animation,$(calibrated_scene)) $(call drawn_of_scene,sidebands,$(graded_scene)) \
  $(call drawn_of_scene,bearing-forces,$(bearing_scene)) $(call drawn_of_scene,efficiency,$(friction_scene)) $(call drawn_of_scene,crack,$(cracked_scene)) $(call drawn_of_scene,residual-signal,$(cracked_scene)) $(call drawn_of_scene,flank-load face-load,$(helical_scene)) \
  $(call of_goals,profile-chart relief-jumps out/figures/profile-chart% out/figures/relief-jumps%,$(relief_scenes) $(standard_scene) $(calibrated_scene)) \
  $(call of_goals,$(system_goals),$(system_scene)) \
  $(if $(filter bench bench-train,$(goals)),$(standard_scene)) $(call of_goals,bench-train,$(train_scene)) $(call of_goals,bench-stress,$(deep_scene) fzg-c) $(if $(filter bench-internal,$(goals)),$(internal_scene)) \
  $(foreach g,$(filter-out out/figures/% out/bodies/% out/studies/% out/reading/%,$(path_goals)),$(word 2,$(subst /, ,$g))))

variants := $(filter $(variant_scenes) $(bifurcation_scenes),$(scenes))
$(foreach s,$(filter-out $(variants) $(study_designs),$(scenes)),$(if $(wildcard $(call scene_file,$s)),,\
  $(error out/$s: there is no data/scenes/$s.toml; for a scene elsewhere say SCENE=path/to/$s.toml)))

# $(call fragment,command): replaces the fragment $@ if the program says otherwise than before. $(call empty_fragments,files): to start from,
# because make complains of an included file that it could not remake.
fragment = @new=$(call new,$@); said=$$($1 --output $$new --out out --ids $(B)/id 2>&1) || { status=$$?; echo "$$said" >&2; exit $$status; }; \
  if cmp -s $$new $@; then rm $$new; else mv $$new $@; echo "$$said" >&2; fi
empty_fragments = $(foreach f,$(filter-out $(wildcard $1),$1),$(shell mkdir -p $(dir $f) && touch $f))

# $(call required,scene): goals that it may not reach, an axis, a mesh and a speed that it may not have
required = $(patsubst %,--goal %,$(filter $(if $(filter $1,$(compared)),compare) $(if $(filter $1,$(scene_stem)),$(pair_goals) $(system_goals) figures $(figures) table1 animation),$(goals))) \
  $(if $(filter $1,$(own_scene)),$(if $(AXIS),--axis '$(AXIS)') $(if $(filter harris-map sound,$(goals)),$(if $(MESH),--mesh '$(MESH)')) $(if $(filter histories sound,$(goals)),$(if $(AT),--at '$(AT)')))

scene_fragments := $(scenes:%=$(B)/scenes/%.mk)
$(call empty_fragments,$(scene_fragments))
$(scene_fragments): $(B)/scenes/%.mk: $(B)/bin/gear-scene FORCE
	$(call fragment,$< --scene '$(call scene_file,$*)' $(call required,$*))

# `+`: fragments are remade under -n as well.
$(variants:%=$(B)/scenes/%.mk): $(B)/scenes/%.mk: out/$(own_scene)/variants/%.toml
$(variants:%=out/$(own_scene)/variants/%.toml): %: $(call scene_file,$(own_scene)) $(B)/bin/gear-scene FORCE
	+@mkdir -p $(@D); $(B)/bin/gear-scene --scene '$<' $(patsubst %,--set %,$(call changes,$(basename $(@F)))) --variant $@
$(study_designs:%=$(B)/scenes/%.mk): $(B)/scenes/%.mk: $(design_folder)/%.toml
$(study_designs:%=$(design_folder)/%.toml): %: $(if $(filter %.toml,$(STUDY)),$(STUDY),data/studies/$(STUDY).toml) $(B)/bin/gear-study FORCE
	+@mkdir -p $(@D); $(B)/bin/gear-study --study '$<' --design $(lastword $(subst -, ,$(basename $(@F)))) --output $@

include $(scene_fragments)

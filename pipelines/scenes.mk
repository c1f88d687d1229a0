# Scenes: which scene files the goals need, and what they tell make.
#
# gear-scene checks a scene and writes the stage parameters that stages depend on (out/S/params/*.toml), the
# keys of each distinct gear (out/bodies/<hash>/body.toml), the links out/S/<gear>, and a fragment of make:
#   SCENE_S_GEARS, SCENE_S_DRIVER, SCENE_S_DRIVEN, SCENE_S_BODY_<gear>, SCENE_S_TORQUES, SCENE_S_REFERENCE_TORQUE,
#   SCENE_S_RINGS_DOWN (no: with its [fidelity], or its teeth, there is no gear-impact), SCENE_S_TEETH (alike, or differ and
#   cracked), SCENE_S_MODIFIED (yes: flanks are not as designed), SCENE_S_BEARINGS (rigid or elastic), SCENE_S_FRICTION (yes, no), BODIES.
# Of a scene of several meshes it says SCENE_S_PLANETS (yes: a [[mesh]] stands for those of several), SCENE_S_SYSTEM := rigid, and
# writes out/S/params/system.toml; or SCENE_S_SYSTEM := elastic with SCENE_S_SYSTEM_GEARS, SCENE_S_BODY_<gear> and BODIES, and
# writes out/S/params/system_static.toml.
# Make remakes a fragment before anything else, under -n as well (gear-scene itself is then compiled, too). This
# happens in every run and costs milliseconds: times cannot tell a scene of the same name in another folder, one that
# went back in time, or deleted stage parameters. All that it writes keeps its time if its content stays.

# SCENE: the user's scene; out/<its stem>/ is made from it. Without it `static`, `fig05` ... are of the paper's scene.
scene_stem := $(basename $(notdir $(SCENE)))
# $(call scene_path,variable,path): a scene is a file whose name can be a folder; scenes of one name share out/<name>, and one's own
# must not take the place of the project's.
scene_meant = $(if $1,; there is $1)
scene_path = $(if $(wildcard $2),,$(error $1=$2: there is no such file$(call scene_meant,$(firstword $(wildcard $2.toml data/scenes/$2 data/scenes/$2.toml)))))$(if $(filter %.toml,$2),,$(error $1=$2: a scene is a .toml file))\
  $(call plain_stem,$1,$2)$(if $(filter figures bodies studies compare reading,$(basename $(notdir $2))),$(error $1=$2: out/$(basename $(notdir $2)) has another use; rename the file))\
  $(call scene_of_project,$1,$2,$(wildcard data/scenes/$(basename $(notdir $2)).toml))
scene_of_project = $(if $3,$(if $(shell cmp -s '$2' $3 || echo differs),$(error $1=$2: out/$(basename $(notdir $2)) is of $3, which says otherwise; rename the file)))
$(if $(SCENE),$(call scene_path,SCENE,$(SCENE)))
# SCENES: two to six for `compare`, the first is what the others are compared with. Other goals do not look at them.
compared_files := $(if $(filter compare,$(goals)),$(SCENES))
$(foreach f,$(compared_files),$(call scene_path,SCENES,$f))
# Or STUDY: the two variants that it marks, as scenes of their own.
compared_study := $(if $(SCENES),,$(if $(filter compare,$(goals)),$(STUDY)))
study_design = out/studies/$(basename $(notdir $(compared_study)))/compare/$1.toml
study_designs := $(if $(compared_study),$(foreach w,first second,$(basename $(notdir $(compared_study)))-$w))
compared := $(or $(study_designs),$(foreach f,$(compared_files),$(basename $(notdir $f))))
$(foreach s,$(compared),$(if $(filter 1,$(words $(filter $s,$(compared)))),,$(error SCENES: two files are called $s.toml$(,) which would share out/$s; rename one)))
$(if $(filter compare,$(goals)),$(if $(filter 2 3 4 5 6,$(words $(compared))),,$(error compare: which scenes? two to six of them: make compare SCENES='a.toml b.toml'; or STUDY=<name>$(,) a study that marks two variants)))
# Of one name they share out/<name>; so does a design of a study with a SCENE of its name.
compared_as_scene := $(if $(scene_stem),$(firstword $(foreach f,$(compared_files),$(if $(filter $(scene_stem),$(basename $(notdir $f))),$f)) $(filter $(scene_stem),$(study_designs))))
$(if $(compared_as_scene),$(if $(filter $(realpath $(SCENE)),$(realpath $(compared_as_scene))),,\
  $(error SCENE=$(SCENE): out/$(scene_stem) is of $(compared_as_scene), which is compared; rename the file)))
own_scene := $(or $(scene_stem),$(paper_scene))

# Variants for `sensitivity`: name:key=value (more keys after commas) is the scene <own scene>-<name>. Those listed are
# what P2000 leaves open, about its scene; half of the damping from mass is 955 1/s at 5 % and 3040 Hz.
VARIANTS ?= bore35:bore_radius_mm=35 bore45:bore_radius_mm=45 dedendum140:dedendum=1.4 dedendum160:dedendum=1.6 \
  fillet05:rack_tip_radius=0.05 fillet20:rack_tip_radius=0.2 poisson27:poisson_ratio=0.27 poisson33:poisson_ratio=0.33 \
  strain:plane=strain inertia139:total_inertia_kgm2=0.0139 inertia157:total_inertia_kgm2=0.0157 \
  mass955:rayleigh_mass_per_s=955 depth025:undamped_depth_mm=0.25 depth100:undamped_depth_mm=1.0 \
  corner_1deg:corner_contact=1 corner_off:corner_contact=false corner_off_mass955:corner_contact=false,rayleigh_mass_per_s=955
variant_name = $(firstword $(subst :, ,$1))
$(foreach v,$(VARIANTS),$(if $(and $(findstring :,$v),$(findstring =,$v)),,$(error VARIANTS: $v: write name:key=value$(,) as in bore35:bore_radius_mm=35))\
  $(if $(strip $(foreach c,/ . + @ $(,) =,$(findstring $c,$(call variant_name,$v)))),$(error VARIANTS: $v: the name '$(call variant_name,$v)' becomes a folder$(,) so it may hold letters$(,) digits$(,) _ and - only)))
variant_scenes := $(foreach v,$(VARIANTS),$(own_scene)-$(firstword $(subst :, ,$v)))
# Finer than the scene, of 8 strips and 61 modes, for `bifurcations`.
halved_step = $(shell awk -F '[= ]+' '$$1 == "steps_per_period" { steps = $$2 } $$1 == "min_sample_rate_kHz" { rate = $$2 } \
  END { printf "steps_per_period=%d,min_sample_rate_kHz=%g", 2 * (steps ? steps : 128), 2 * (rate ? rate : 250) }' '$(subst ','\'',$(or $(SCENE),data/scenes/$(own_scene).toml))')
BIFURCATION_VARIANTS := $(if $(filter bifurcations,$(goals)),halfstep:$(halved_step) strips16:strips=16 modes122:modes=122)
bifurcation_scenes := $(foreach v,$(BIFURCATION_VARIANTS),$(own_scene)-$(firstword $(subst :, ,$v)))
variant_file = out/$(own_scene)/variants/$1.toml

scene_file = $(if $(filter $1,$(study_designs)),$(study_design),$(if $(filter $1,$(compared)),$(firstword $(foreach f,$(compared_files),$(if $(filter $1,$(basename $(notdir $f))),$f))),$(if $(filter $(scene_stem),$1),$(SCENE),$(if $(filter $1,$(variant_scenes) $(bifurcation_scenes)),$(variant_file),data/scenes/$1.toml))))

# that need a scene of a pair, SCENE or the paper's
pair_goals := mesh reduce static loaded impact calibrate sweep histories sound runup lumped branches jump-map fold-curves sensitivity harris-map report teeth export
path_goals := $(filter out/%,$(goals))
scenes := $(sort \
  $(if $(filter $(pair_goals) out/bodies/%,$(goals)),$(own_scene)) \
  $(if $(filter compare,$(goals)),$(compared)) $(if $(filter out/compare/%,$(goals)),$(error out/compare: say make compare SCENES='a.toml b.toml')) \
  $(if $(filter sensitivity out/figures/sensitivity%,$(goals)),$(variant_scenes)) \
  $(if $(filter bifurcations,$(goals)),$(own_scene) $(bifurcation_scenes)) \
  $(if $(filter jump-folds,$(goals)),$(own_scene)) \
  $(if $(filter $(figures) table1 figures,$(goals)),$(if $(SCENE),$(own_scene),$(shown_scenes))) \
  $(if $(filter animation,$(goals)),$(if $(SCENE),$(own_scene),$(calibrated_scene))) \
  $(if $(filter sidebands out/figures/sidebands%,$(goals)),$(if $(SCENE),$(own_scene),$(graded_scene))) \
  $(if $(filter bearing-forces out/figures/bearing-forces%,$(goals)),$(if $(SCENE),$(own_scene),$(bearing_scene))) \
  $(if $(filter efficiency out/figures/efficiency%,$(goals)),$(if $(SCENE),$(own_scene),$(friction_scene))) \
  $(if $(filter modes mode-shapes,$(goals)),$(if $(SCENE),$(own_scene),$(system_scene))) \
  $(if $(filter system-static system-sweep system-ringdown system-branch,$(goals)),$(if $(SCENE),$(own_scene),$(elastic_system_scene))) \
  $(if $(filter crack out/figures/crack%,$(goals)),$(if $(SCENE),$(own_scene),$(cracked_scene))) \
  $(if $(filter scorecard out/figures/%,$(goals)),$(paper_scenes)) \
  $(if $(filter profile-chart relief-jumps out/figures/profile-chart% out/figures/relief-jumps%,$(goals)),$(if $(SCENE),,$(relief_scenes) $(standard_scene) $(calibrated_scene))) \
  $(if $(filter bench,$(goals)),$(standard_scene)) $(if $(filter bench-stress,$(goals)),$(if $(SCENE),$(own_scene),$(deep_scene) fzg-c)) $(if $(filter bench-internal,$(goals)),$(internal_scene)) $(if $(filter work-precision,$(goals)),$(deep_scene)) \
  $(foreach g,$(filter-out out/figures/% out/bodies/% out/studies/% out/reading/% out/compare/%,$(path_goals)),$(word 2,$(subst /, ,$g))))

$(foreach s,$(filter-out $(variant_scenes) $(bifurcation_scenes) $(study_designs),$(scenes)),$(if $(wildcard $(call scene_file,$s)),,\
  $(error out/$s: there is no data/scenes/$s.toml; for a scene elsewhere say SCENE=path/to/$s.toml)))

scene_fragments := $(scenes:%=$(B)/scenes/%.mk)
# An empty fragment to start from, because make complains of an included file that it could not remake.
$(foreach f,$(filter-out $(wildcard $(scene_fragments)),$(scene_fragments)),$(shell mkdir -p $(dir $f) && touch $f))

$(scene_fragments): $(B)/scenes/%.mk: $(B)/bin/gear-scene FORCE
	@new=$(call new,$@); said=$$($< --scene '$(call scene_file,$*)' --output $$new --out out --ids $(B)/id 2>&1) || { status=$$?; echo "$$said" >&2; exit $$status; }; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; echo "$$said" >&2; fi

# `+`: fragments are remade under -n as well.
define variant_rules # name, changes
$(B)/scenes/$(own_scene)-$1.mk: $(call variant_file,$(own_scene)-$1)
$(call variant_file,$(own_scene)-$1): $(call scene_file,$(own_scene)) $(B)/bin/gear-scene FORCE
	+@mkdir -p $$(@D); $(B)/bin/gear-scene --scene '$$<' $(patsubst %,--set %,$(subst $(,), ,$2)) --variant $$@
endef
$(foreach v,$(VARIANTS) $(BIFURCATION_VARIANTS),$(if $(filter $(own_scene)-$(firstword $(subst :, ,$v)),$(scenes)),\
  $(eval $(call variant_rules,$(firstword $(subst :, ,$v)),$(lastword $(subst :, ,$v))))))

define design_rules # name, first or second
$(B)/scenes/$1.mk: $(call study_design,$1)
$(call study_design,$1): $(if $(filter %.toml,$(STUDY)),$(STUDY),data/studies/$(STUDY).toml) $(B)/bin/gear-study FORCE
	+@mkdir -p $$(@D); $(B)/bin/gear-study --study '$$<' --design $2 --output $$@
endef
$(foreach d,$(study_designs),$(eval $(call design_rules,$d,$(lastword $(subst -, ,$d)))))

include $(scene_fragments)

# What a tooth carries is of intact, equal teeth; of others there are parts. A fragment is empty until make has remade it, then make starts again.
$(if $(filter teeth,$(goals)),$(if $(SCENE),$(if $(SCENE_$(own_scene)_TEETH),$(if $(call teeth,$(own_scene),alike),,$(error teeth: SCENE=$(SCENE) has teeth \
  that $(if $(call teeth,$(own_scene),differ),differ,are cracked)$(,) and root stress$(,) load sharing and error budget are of intact$(,) equal teeth; for it there is: \
  make SCENE=$(SCENE) $(if $(call teeth,$(own_scene),cracked),$(if $(call teeth,$(own_scene),differ),fig01,crack),tooth-loads sidebands))))))

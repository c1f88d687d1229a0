# What the choices that P2000 does not state are worth: maps of jumps, folds, and the sensitivity of the response quantities to each input.
#
#   jump-map      out/S/T150/jump_map_false.h5, jump_map_1.h5 (degrees), jump_map_true.h5: one per torque and corner rule. Lumped models are
#                 artifacts of the same schema, by their name: jump_map_secant.h5, jump_map_secant-contact.h5 (damper in contact only)
#   fold-curves   out/S/T150/fold_curves_damping.h5; FOLDS_OVER=torque, bearing_stiffness, of pairs tip_relief: at TORQUE only
#   sensitivity   out/S-bore35/T150/branches.h5: one per variant (scenes.mk)
#   harris-map    out/S/harris_map.h5; of a train MESH=sun-planet1: out/S/harris_sun-planet1.h5; HARRIS_DYNAMIC=yes: out/S/harris_dynamic.h5, with sweeps at every point of a coarse grid
#
# JUMP_MAP=fine, SENSITIVITY=fine: ..._fine.h5 beside them. Torques in N m (of a scene of yours: those that it lists), corner rules as in a
# scene (none, up to an angle, full), damping ratios with two pairs in contact, steps of the speeds in Hz.
JUMP_MAP_CORNERS ?= false 1 true
# no: the curves of folds alone, which cost a part of the cells
JUMP_MAP_CELLS ?= yes
# Lumped models, those of `make lumped`; -contact: the damper acts in contact only. Their ratios are about the mean stiffness.
JUMP_MAP_MODELS ?= rectangular secant tangent pairs rectangular-contact secant-contact tangent-contact pairs-contact
JUMP_MAP_RATIOS ?= 0.03 0.035 0.04 0.045 0.05 0.055 0.06 0.065 0.07 0.075 0.08 0.09 0.10
JUMP_MAP_STEP ?= 50
fine_ratios := 0.025 0.03 0.035 0.04 0.045 0.05 0.055 0.06 0.065 0.07 0.075 0.08 0.085 0.09 0.095 0.10
fine_step := 20
# The speed in Hz at which loads are stored apart: that of P2000's Figures 8 and 10.
JUMP_MAP_LOADS_AT ?= $(if $(SCENE),,2400)
# P2000's damping is measured, so variants are compared at one ratio; the factor is one with two branches. First line of
# the cases: the factor as it is.
SENSITIVITY_FACTOR ?= 5.5e-6
SENSITIVITY_RATIO ?= 0.05
SENSITIVITY_STEP ?= 50
FOLDS_OVER ?= damping
FOLD_RATIOS ?= 0.055 0.06 0.065 0.07 0.075 0.08 0.085 0.09 0.10
FOLD_TORQUES ?= 50 75 100 125 150 175 200 250 300 450 600
FOLD_RELIEFS ?= 0 0.5 1 1.5 2 2.5 3 4 5 6
FOLD_STIFFNESSES ?= 0.5 0.6 0.7 0.8 0.9 1 1.1 1.25 1.5 2
FOLD_FIRST ?= 0.07
FOLD_CURVE_TORQUES ?= $(if $(SCENE),$(SCENE_$(own_scene)_TORQUES),100 150 200 300 600)
# Options of gear-harris. TORQUE is the design torque; without --torque and --relief-um the map goes to twice that and to what
# teeth bend there. Of a grid of sweeps each point takes seconds.
HARRIS_OPTIONS ?= $(if $(HARRIS_DYNAMIC),--torque 50:300:6 --relief-um 0:12:7)

# Options in files of their own, per scene (plan_text in stages.mk).
comma_list = $(subst $() $(),$(,),$(strip $1))
loads_at = $(if $(JUMP_MAP_LOADS_AT),--loads-at $(JUMP_MAP_LOADS_AT))
plan_jump_map := --damping-ratio $(call comma_list,$(JUMP_MAP_RATIOS)) --step $(JUMP_MAP_STEP) $(loads_at)
plan_jump_map_fine := --damping-ratio $(call comma_list,$(fine_ratios)) --step $(fine_step) $(loads_at)
sensitivity_cases := --rayleigh-stiffness $(SENSITIVITY_FACTOR) --damping-ratio $(SENSITIVITY_RATIO) $(loads_at)
plan_branches := $(sensitivity_cases) --step $(SENSITIVITY_STEP)
plan_branches_fine := $(sensitivity_cases) --step $(fine_step)
plan_harris_map := --design-torque $(TORQUE) --check 12 $(HARRIS_OPTIONS)
plan_harris_dynamic := --design-torque $(TORQUE) $(HARRIS_OPTIONS) --dynamic
# --first: where a branch gives the folds; over torque the torque of the path.
folded := damping torque tip_relief bearing_stiffness
plan_fold_curves_damping := --over damping --first $(FOLD_FIRST) --values $(call comma_list,$(FOLD_RATIOS))
plan_fold_curves_torque := --over torque --values $(call comma_list,$(FOLD_TORQUES))
plan_fold_curves_tip_relief := --over tip_relief --first 0 --values $(call comma_list,$(FOLD_RELIEFS))
plan_fold_curves_bearing_stiffness := --over bearing_stiffness --first 1 --values $(call comma_list,$(FOLD_STIFFNESSES))

map_plan := jump_map$(call fineness,JUMP_MAP)
branches_plan := branches$(call fineness,SENSITIVITY)
own_pair := $(if $(call is_pair,$(own_scene)),out/$(own_scene))
own_plans := $(if $(own_pair),$(B)/plans/$(own_scene))
# What a map is of, in its name: jump_map_<corner rule or model>.h5, ..._fine.h5; of a lumped model its plan is jump_map_<model>, jump_map_fine_<model>.
mapped = $(patsubst jump_map_%,%,$(patsubst %$(call fineness,JUMP_MAP).h5,%,$(@F)))
lumped_map = --model $(firstword $(subst -, ,$2)) $(if $(filter %-contact,$2),--damper contact) $(lumped_mass) $(lumped_options_$(2:%-contact=%))
plan_of_map = $(if $(filter $(map_plan)_%,$(@F)),$(call lumped_map,$(plan_scene),$(@F:$(map_plan)_%=%)) $(plan_$(map_plan)))
plans += $(if $(own_plans),$(addprefix $(own_plans)/,jump_map jump_map_fine branches branches_fine harris_map harris_dynamic $(JUMP_MAP_MODELS:%=$(map_plan)_%)))

map_places := $(if $(own_pair),$(patsubst %,$(own_pair)/T%,$(sort $(map_torques) $(call torques,$(own_scene)))))
# $(call maps_of,places,corner rules or models)
maps_of = $(foreach m,$2,$(foreach p,$1,$p/$(subst jump_map,jump_map_$m,$(map_plan)).h5))
map_inputs = $(call params,map) $(call params,static) $(bodies)
map_options = --params $(call params,map) --static-params $(call params,static) $(by_gear) --torque $(torque)
$(call maps_of,$(map_places),$(JUMP_MAP_CORNERS)): $$(map_inputs) $(call id,gear-jump-map) $(own_plans)/$(map_plan) | $(B)/bin/gear-jump-map
	$(call run,jump-map) $(map_options) --corner-contact $(mapped) $(plan_$(map_plan)) --output $@ $(call landed,jump-map)

branches_files := $(foreach s,$(filter $(own_scene) $(variant_scenes),$(pairs)),out/$s/T$(TORQUE)/$(branches_plan).h5)
$(branches_files): $$(map_inputs) $(call id,gear-jump-map) $(B)/plans/$(own_scene)/$(branches_plan) | $(B)/bin/gear-jump-map
	$(call run,jump-map) $(map_options) $(plan_$(branches_plan)) --output $@ $(call landed,jump-map)

$(call maps_of,$(map_places),$(JUMP_MAP_MODELS)): $$(call params,lumped_map) $$(at)/static.h5 $$(if $$(filter rectangular%,$$(mapped)),$$(first_static)) $(call id,gear-lumped) \
    $(own_plans)/$(map_plan)_$$(mapped) | $(B)/bin/gear-lumped
	$(call run,lumped) --map $(call lumped_map,$(scene),$(mapped)) --params $< --static $(at)/static.h5 $(plan_$(map_plan)) --output $@ $(call landed,lumped)

# Of a train at its own torque.
fold_torque := $(if $(filter $(trains),$(own_scene)),$(SCENE_$(own_scene)_TORQUES),$(TORQUE))
fold_places := $(if $(filter yes,$(SCENE_$(own_scene)_MOVES)),$(patsubst %,out/$(own_scene)/T%,$(sort $(FOLD_CURVE_TORQUES) $(fold_torque))))
fold_plans := $(if $(fold_places),$(folded:%=$(B)/plans/$(own_scene)/fold_curves_%))
plans += $(fold_plans)
of_pair = $(if $(call is_pair,$(scene)),$1)
$(foreach q,$(folded),$(fold_places:%=%/fold_curves_$q.h5)): $$(call params,sweep) $$(call of_pair,$$(call params,static)) $$(bodies) $(call id,gear-folds) $(B)/plans/$(own_scene)/$$(basename $$(@F)) | $(B)/bin/gear-folds
	$(call run,folds) --params $< $(by_gear) $(call of_pair,--static-params $(call params,static) --torque $(torque) )$(plan_$(basename $(@F))) $(if $(filter %_torque.h5,$@),--first $(torque)) --output $@ $(call landed,folds)

$(own_pair:%=%/harris_map.h5): $$(call params,static) $$(bodies) $(call id,gear-harris) $(own_plans)/harris_map | $(B)/bin/gear-harris
	$(call run,harris) --static-params $< $(by_gear) $(plan_harris_map) --output $@ $(call landed,harris)
$(own_pair:%=%/harris_dynamic.h5): $$(call params,static) $$(bodies) $(call id,gear-harris) $$(call params,sweep) $$(first_static) $(own_plans)/harris_dynamic | $(B)/bin/gear-harris
	$(call run,harris) --static-params $< $(by_gear) $(plan_harris_dynamic) --params $(call params,sweep) --reference-static $(first_static) --output $@ $(call landed,harris)

# Of one mesh of a train; the torque is what it carries, unless it is given.
mapped_mesh := $(if $(and $(filter harris-map,$(goals)),$(filter $(trains),$(own_scene))),$(or $(filter $(MESH),$(SCENE_$(own_scene)_MESHES)),$(if $(SCENE_$(own_scene)_MESHES),\
  $(error harris-map: MESH=$(MESH): say of which mesh of the train, one of $(SCENE_$(own_scene)_MESHES)))))
$(if $(mapped_mesh),$(if $(HARRIS_DYNAMIC),$(error HARRIS_DYNAMIC: the map of a mesh of a train is at rest; leave it out)))
plan_harris_mesh := $(if $(mapped_mesh),--mesh $(mapped_mesh) $(if $(filter command,$(firstword $(origin TORQUE))),--design-torque $(TORQUE)) --check 12 $(HARRIS_OPTIONS))
$(mapped_mesh:%=out/$(own_scene)/harris_%.h5): $$(call params,static) $$(bodies) $(call id,gear-harris) $(B)/plans/$(own_scene)/harris_mesh | $(B)/bin/gear-harris
	$(call run,harris) --static-params $< $(by_gear) $(plan_harris_mesh) --output $@ $(call landed,harris)
plans += $(if $(mapped_mesh),$(B)/plans/$(own_scene)/harris_mesh)

# Their figures: by the rule of all figures, in figures.mk.
harris_map := harris_$(or $(mapped_mesh),$(if $(HARRIS_DYNAMIC),dynamic,map))
of_torques = $(1:%=out/$(own_scene)/T%)
fold_figure := $(figure_folder)/fold-curves$(if $(filter-out damping,$(FOLDS_OVER)),-$(subst _,-,$(FOLDS_OVER)))
inputs_fold-curves = $(addsuffix /fold_curves_$(FOLDS_OVER).h5,$(call of_torques,$(if $(filter damping,$(FOLDS_OVER)),$(FOLD_CURVE_TORQUES),$(fold_torque))))
inputs_jump-map = $(call maps_of,$(call of_torques,$(map_torques)),$(JUMP_MAP_CORNERS)) $(addsuffix /fold_curves_damping.h5,$(call of_torques,$(FOLD_CURVE_TORQUES)))
inputs_jump-map-lumped = $(call maps_of,$(call of_torques,$(map_torques)),$(JUMP_MAP_CORNERS) $(JUMP_MAP_MODELS))
inputs_harris-map = out/$(own_scene)/$(harris_map).h5
inputs_sensitivity = $(foreach s,$(own_scene) $(variant_scenes),out/$s/T$(TORQUE)/$(branches_plan).h5)

.PHONY: jump-map fold-curves sensitivity harris-map
drawn_map = $(foreach f,$1,$(foreach e,tsv svg png,$f.$e))
dash_fine = $(subst _,-,$(call fineness,$1))
fold-curves: $(call drawn_map,$(fold_figure)) ## folds of the branches against damping, with their cusps; FOLDS_OVER=torque, bearing_stiffness, of pairs tip_relief
harris-map: $(call drawn_map,$(figure_folder)/$(if $(mapped_mesh),harris-map-$(mapped_mesh),$(subst _,-,$(harris_map)))) ## peak-to-peak transmission error against torque and tip relief, the optimum for TORQUE, the Harris cusp; HARRIS_DYNAMIC=yes; of one mesh of a train: MESH=sun-planet1
jump-map: $(call drawn_map,$(if $(filter no,$(JUMP_MAP_CELLS)),$(fold_figure),$(figure_folder)/jump-map$(call dash_fine,JUMP_MAP) $(if $(JUMP_MAP_MODELS),$(figure_folder)/jump-map-lumped$(call dash_fine,JUMP_MAP)))) ## two branches, contact loss, tooth loads against torque, damping, corner rule, lumped model; JUMP_MAP=fine, JUMP_MAP_CELLS=no
sensitivity: $(call drawn_map,$(figure_folder)/sensitivity$(call dash_fine,SENSITIVITY)) ## what each input that the paper does not state changes; SENSITIVITY=fine

$(sort $(plans) $(plans_of_figures)): $$(call differs,$$@,$$(plan_text))
	$(call write_plan,$(plan_text))

# What the choices that P2000 does not state are worth: maps of jumps, and the sensitivity of the response quantities to each input.
#
#   make jump-map                    coarse; JUMP_MAP=fine beside it. One artifact per torque and corner rule:
#                                    out/S/T150/jump_map_false.h5, jump_map_1.h5 (degrees), jump_map_true.h5; fine: ..._fine.h5
#   make sensitivity                 coarse; SENSITIVITY=fine beside it. One artifact per variant of the scene:
#                                    out/S-bore35/T150/branches.h5; pipelines/scenes.mk lists the variants
#   make SCENE=x.toml jump-map       of a scene of yours, figures in out/x/report/
#
# Lumped models are artifacts of the same schema, by their name instead of a corner rule: out/S/T150/jump_map_secant.h5,
# jump_map_secant-contact.h5 (damper in contact only). They have a figure of their own, jump-map-lumped, beside the elastic pair.

#   make harris-map                  out/S/harris_map.h5: transmission error at rest against torque and tip relief;
#                                    HARRIS_DYNAMIC=yes: out/S/harris_dynamic.h5, with sweeps at every point of a coarse grid
#
# Torques in N m (of a scene of yours: those that it lists), corner rules as in a scene (none, up to an angle, full), damping
# ratios with two pairs in contact, steps of the speeds in Hz.
JUMP_MAP_TORQUES ?= $(if $(SCENE),$(SCENE_$(own_scene)_TORQUES),20 50 100 150 200 300 450 600)
JUMP_MAP_CORNERS ?= false 1 true
# Lumped models, those of `make lumped`; -contact: the damper acts in contact only. Their ratios are about the mean stiffness.
JUMP_MAP_MODELS ?= rectangular secant tangent pairs rectangular-contact secant-contact tangent-contact pairs-contact
JUMP_MAP_RATIOS ?= 0.03 0.035 0.04 0.045 0.05 0.055 0.06 0.065 0.07 0.075 0.08 0.09 0.10
JUMP_MAP_STEP ?= 50
fine_torques := $(if $(SCENE),$(JUMP_MAP_TORQUES),20 35 50 75 100 125 150 175 200 250 300 350 400 450 500 600)
fine_ratios := 0.025 0.03 0.035 0.04 0.045 0.05 0.055 0.06 0.065 0.07 0.075 0.08 0.085 0.09 0.095 0.10
fine_step := 20
# The speed in Hz at which loads are stored apart: that of P2000's Figures 8 and 10.
JUMP_MAP_LOADS_AT ?= $(if $(SCENE),,2400)
# P2000's damping is measured, so variants are compared at one ratio; the factor is one with two branches. First line of
# the cases: the factor as it is.
SENSITIVITY_FACTOR ?= 5.5e-6
SENSITIVITY_RATIO ?= 0.05
SENSITIVITY_STEP ?= 50

# Options of gear-harris. TORQUE is the design torque; without --torque and --relief-um the map goes to twice that and to what
# teeth bend there. Of a grid of sweeps each point takes seconds.
HARRIS_OPTIONS ?= $(if $(HARRIS_DYNAMIC),--torque 50:300:6 --relief-um 0:12:7)

$(foreach v,JUMP_MAP SENSITIVITY,$(if $(filter-out coarse fine,$($v)),$(error $v=$($v): it is coarse or fine)))
fineness = $(if $(filter fine,$($1)),_fine)

blank :=
comma_list = $(subst $(blank) $(blank),$(,),$(strip $1))
loads_at = $(if $(JUMP_MAP_LOADS_AT),--loads-at $(JUMP_MAP_LOADS_AT))
plan_jump_map := --damping-ratio $(call comma_list,$(JUMP_MAP_RATIOS)) --step $(JUMP_MAP_STEP) $(loads_at)
plan_jump_map_fine := --damping-ratio $(call comma_list,$(fine_ratios)) --step $(fine_step) $(loads_at)
sensitivity_cases := --rayleigh-stiffness $(SENSITIVITY_FACTOR) --damping-ratio $(SENSITIVITY_RATIO) $(loads_at)
plan_branches := $(sensitivity_cases) --step $(SENSITIVITY_STEP)
plan_branches_fine := $(sensitivity_cases) --step $(fine_step)

# Options in files of their own, per scene, replaced if they change: so that other options redo what they made.
plan_harris_map := --design-torque $(TORQUE) --check 12 $(HARRIS_OPTIONS)
plan_harris_dynamic := --design-torque $(TORQUE) $(HARRIS_OPTIONS) --dynamic
plans := jump_map jump_map_fine branches branches_fine harris_map harris_dynamic
$(foreach p,$(plans),$(eval $(call plan_rule,$(B)/plans/$(own_scene)/$p,$(plan_$p))))

jump_map_inputs = out/$1/params/map.toml out/$1/params/static.toml $(pair_bodies) $(call id,gear-jump-map)
jump_map_options = --params out/$1/params/map.toml --static-params out/$1/params/static.toml $(pair_options)

define jump_map_rules # scene, torque, corner rule, plan
out/$1/T$2/$(subst jump_map,jump_map_$3,$4).h5: $(jump_map_inputs) $(B)/plans/$(own_scene)/$4 | $(B)/bin/gear-jump-map
	$$(call run,jump-map) $(jump_map_options) --torque $2 --corner-contact $3 $(plan_$4) --output $$@ $$(call landed,jump-map)
endef

lumped_map_options = --model $(firstword $(subst -, ,$2)) $(if $(filter %-contact,$2),--damper contact) $(lumped_mass) $(lumped_options_$(patsubst %-contact,%,$2))
lumped_map_plan = $(B)/plans/$1/$3_$2
$(foreach m,$(JUMP_MAP_MODELS),$(foreach p,jump_map jump_map_fine,$(eval $(call plan_rule,$(call lumped_map_plan,$(own_scene),$m,$p),\
  $(call lumped_map_options,$(own_scene),$m) $(plan_$p)))))

lumped_map_inputs = out/$1/params/lumped_map.toml out/$1/T$2/static.h5 $(if $(filter rectangular%,$3),$(reference_static)) $(call id,gear-lumped)

# Folds of the branches over damping, torque and tip relief: curves in place of the cells, or over them.
#   make fold-curves                 out/S/T150/fold_curves_damping.h5; FOLDS_OVER=torque, tip_relief: at TORQUE only
# --first: where a branch gives the folds; over torque the torque of the path.
FOLDS_OVER ?= damping
FOLD_RATIOS ?= 0.055 0.06 0.065 0.07 0.075 0.08 0.085 0.09 0.10
FOLD_TORQUES ?= 50 75 100 125 150 175 200 250 300 450 600
FOLD_RELIEFS ?= 0 0.5 1 1.5 2 2.5 3 4 5 6
FOLD_FIRST ?= 0.07
FOLD_CURVE_TORQUES ?= $(if $(SCENE),$(SCENE_$(own_scene)_TORQUES),100 150 200 300 600)
$(if $(filter-out damping torque tip_relief,$(FOLDS_OVER)),$(error FOLDS_OVER=$(FOLDS_OVER): it is damping, torque or tip_relief))
plan_fold_curves_damping := --over damping --first $(FOLD_FIRST) --values $(call comma_list,$(FOLD_RATIOS))
plan_fold_curves_torque := --over torque --values $(call comma_list,$(FOLD_TORQUES))
plan_fold_curves_tip_relief := --over tip_relief --first 0 --values $(call comma_list,$(FOLD_RELIEFS))
$(foreach q,damping torque tip_relief,$(eval $(call plan_rule,$(B)/plans/$(own_scene)/fold_curves_$q,$(plan_fold_curves_$q))))

fold_curves_inputs = out/$1/params/sweep.toml out/$1/params/static.toml $(pair_bodies) $(call id,gear-folds)
define fold_curves_rules # scene, torque, quantity
out/$1/T$2/fold_curves_$3.h5: $(fold_curves_inputs) $(B)/plans/$(own_scene)/fold_curves_$3 | $(B)/bin/gear-folds
	$$(call run,folds) --params out/$1/params/sweep.toml --static-params out/$1/params/static.toml $(pair_options) --torque $2 $(plan_fold_curves_$3) $(if $(filter torque,$3),--first $2) --output $$@ $$(call landed,folds)
endef
fold_torques := $(if $(filter damping,$(FOLDS_OVER)),$(FOLD_CURVE_TORQUES),$(TORQUE))
$(if $(SCENE_$(own_scene)_GEARS),$(foreach t,$(sort $(FOLD_CURVE_TORQUES) $(TORQUE)),$(foreach q,damping torque tip_relief,\
  $(eval $(call fold_curves_rules,$(own_scene),$t,$q)))))
fold_curves_artifacts := $(fold_torques:%=out/$(own_scene)/T%/fold_curves_$(FOLDS_OVER).h5)

define lumped_map_rules # scene, torque, model, plan
out/$1/T$2/$(subst jump_map,jump_map_$3,$4).h5: $(lumped_map_inputs) $(call lumped_map_plan,$1,$3,$4) | $(B)/bin/gear-lumped
	$$(call run,lumped) --map $(call lumped_map_options,$1,$3) --params $$< --static out/$1/T$2/static.h5 $(plan_$4) --output $$@ $$(call landed,lumped)
endef

define branches_rules # scene, torque, plan
out/$1/T$2/$3.h5: $(jump_map_inputs) $(B)/plans/$(own_scene)/$3 | $(B)/bin/gear-jump-map
	$$(call run,jump-map) $(jump_map_options) --torque $2 $(plan_$3) --output $$@ $$(call landed,jump-map)
endef

map_torques := $(if $(call fineness,JUMP_MAP),$(fine_torques),$(JUMP_MAP_TORQUES))
map_plan := jump_map$(call fineness,JUMP_MAP)
branches_plan := branches$(call fineness,SENSITIVITY)
$(if $(SCENE_$(own_scene)_GEARS),\
  $(foreach c,$(JUMP_MAP_CORNERS),$(foreach t,$(sort $(map_torques) $(call torques,$(own_scene))),\
    $(eval $(call jump_map_rules,$(own_scene),$t,$c,$(map_plan))))))
# Statics at torques that nothing else asks for.
$(if $(SCENE_$(own_scene)_GEARS),\
  $(foreach t,$(filter-out $(call torques,$(own_scene)),$(map_torques)),$(eval $(call static_rules,$(own_scene),$t)))\
  $(foreach m,$(JUMP_MAP_MODELS),$(foreach t,$(sort $(map_torques) $(call torques,$(own_scene))),\
    $(eval $(call lumped_map_rules,$(own_scene),$t,$m,$(map_plan))))))
$(foreach s,$(filter $(own_scene) $(variant_scenes),$(scenes)),$(if $(SCENE_$s_GEARS),\
  $(eval $(call branches_rules,$s,$(TORQUE),$(branches_plan)))))

harris_inputs = out/$1/params/static.toml $(pair_bodies) $(call id,gear-harris)
harris_options = --static-params out/$1/params/static.toml $(pair_options)

define harris_rules # scene
out/$1/harris_map.h5: $(harris_inputs) $(B)/plans/$1/harris_map | $(B)/bin/gear-harris
	$$(call run,harris) $(harris_options) $(plan_harris_map) --output $$@ $$(call landed,harris)

out/$1/harris_dynamic.h5: $(harris_inputs) out/$1/params/sweep.toml $(reference_static) $(B)/plans/$1/harris_dynamic | $(B)/bin/gear-harris
	$$(call run,harris) $(harris_options) $(plan_harris_dynamic) --params out/$1/params/sweep.toml \
	  --reference-static $(reference_static) --output $$@ $$(call landed,harris)
endef
$(if $(SCENE_$(own_scene)_GEARS),$(eval $(call harris_rules,$(own_scene))))

map_folder := $(if $(SCENE),out/$(own_scene)/report,out/figures)
map_figure := $(map_folder)/jump-map$(subst _,-,$(call fineness,JUMP_MAP))
lumped_map_figure := $(map_folder)/jump-map-lumped$(subst _,-,$(call fineness,JUMP_MAP))
sensitivity_figure := $(map_folder)/sensitivity$(subst _,-,$(call fineness,SENSITIVITY))
maps_of = $(foreach c,$1,$(foreach t,$(map_torques),out/$(own_scene)/T$t/$(subst jump_map,jump_map_$c,$(map_plan)).h5))
map_artifacts := $(call maps_of,$(JUMP_MAP_CORNERS))
lumped_map_artifacts := $(call maps_of,$(JUMP_MAP_MODELS))
harris_map := harris_$(if $(HARRIS_DYNAMIC),dynamic,map)
harris_figure := $(map_folder)/$(subst _,-,$(harris_map))
sensitivity_artifacts := $(foreach s,$(own_scene) $(variant_scenes),out/$s/T$(TORQUE)/$(branches_plan).h5)

define map_figure_rules # figure, path without extension, artifacts
$(call together,$2.tsv $2.svg $2.png) &: $3 out/$(own_scene)/params/title.txt $(call template,$1) pipelines/plots/common.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	@mkdir -p $(map_folder)
	$(B)/bin/gear-plot $1 --output $2 $3
endef
fold_figure := $(map_folder)/fold-curves$(if $(filter-out damping,$(FOLDS_OVER)),-$(subst _,-,$(FOLDS_OVER)))
# The cells are there if they are asked for: JUMP_MAP_CELLS=no draws the curves alone, which cost a part of them.
JUMP_MAP_CELLS ?= yes
damping_curves := $(FOLD_CURVE_TORQUES:%=out/$(own_scene)/T%/fold_curves_damping.h5)
$(eval $(call map_figure_rules,jump-map,$(map_figure),$(map_artifacts) $(damping_curves)))
$(eval $(call map_figure_rules,fold-curves,$(fold_figure),$(fold_curves_artifacts)))
$(if $(JUMP_MAP_MODELS),$(eval $(call map_figure_rules,jump-map-lumped,$(lumped_map_figure),$(map_artifacts) $(lumped_map_artifacts))))
$(eval $(call map_figure_rules,harris-map,$(harris_figure),out/$(own_scene)/$(harris_map).h5))
$(eval $(call map_figure_rules,sensitivity,$(sensitivity_figure),$(sensitivity_artifacts)))

.PHONY: jump-map fold-curves sensitivity harris-map
fold-curves: $(foreach e,tsv svg png,$(fold_figure).$e) ## folds of the branches against damping, with their cusps; FOLDS_OVER=torque, tip_relief
harris-map: $(foreach e,tsv svg png,$(harris_figure).$e) ## peak-to-peak transmission error against torque and tip relief, the optimum for TORQUE, the Harris cusp; HARRIS_DYNAMIC=yes
jump-map: $(foreach f,$(if $(filter no,$(JUMP_MAP_CELLS)),$(fold_figure),$(map_figure) $(if $(JUMP_MAP_MODELS),$(lumped_map_figure))),$(foreach e,tsv svg png,$f.$e)) ## two branches, contact loss, tooth loads against torque, damping, corner rule, lumped model; JUMP_MAP=fine, JUMP_MAP_CELLS=no
sensitivity: $(foreach e,tsv svg png,$(sensitivity_figure).$e) ## what each input that the paper does not state changes; SENSITIVITY=fine

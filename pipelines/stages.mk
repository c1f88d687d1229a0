# Stages: scene -> mesh.h5 -> body.h5 -> static.h5 -> sweep.h5 -> response.h5, static.h5 -> impact.h5, and
# static.h5 -> sweep.h5 of a lumped model -> response.h5. Of a train motions need bodies alone, static.h5 -> modes.h5; of rigid gears
# scene -> modes.h5.
#
# A stage depends on the stage parameters that it reads, on the artifacts that it reads, and on the id of its
# program. Bodies are per distinct gear (out/bodies/<hash>), operating points are targets: the torque stands in the path. A rule is of all
# scenes and torques: it takes them from the path of its target, prerequisites in the second expansion ($$).

# $(call run,stage): how a stage starts; LAUNCH may carry the heavy ones to other machines.
launch = $(or $(LAUNCH_$1),$(LAUNCH))
run = $(if $(call launch,$1),$(call launch,$1) )$(B)/bin/gear-$1

# $(call landed,stage): behind it. A launcher that has ended well without its program having run ends the recipe, also where an
# earlier file is still there; a file that another machine has written may be seen late, so it is waited for, in seconds.
LAUNCH_WAIT ?= 60
landed = $(if $(call launch,$1),&& { for second in $$(seq 0 $(LAUNCH_WAIT)); do \
  fresh=yes; for input in $^; do [ -e $@ ] && [ ! $$input -nt $@ ] || fresh=; done; [ -z "$$fresh" ] || exit 0; [ $$second = $(LAUNCH_WAIT) ] || sleep 1; done; \
  echo "$@: the launcher '$(call launch,$1)' has ended$(,) but its result is not there after $(LAUNCH_WAIT) s" >&2; exit 1; })

# Of the target out/<scene>/T<torque>/...: its words, and what its stage reads.
part = $(word $1,$(subst /, ,$@))
scene = $(call part,2)
torque = $(patsubst T%,%,$(call part,3))
at = out/$(scene)/T$(torque)
params = out/$(scene)/params/$1.toml
bodies = $(call bodies_of,$(scene))
by_gear = $(call named,--body,$(scene),body)
first_static = $(call reference_static,$(scene))
at_rest = $(if $(call is_pair,$(scene)),$(at)/static.h5 $(first_static))
by_static = $(by_gear) $(if $(at_rest),--static $(at)/static.h5 --reference-static $(first_static))

is_pair = $(filter pair,$(SCENE_$1_KIND))
# Of a pair the driver first.
gears_of = $(or $(strip $(SCENE_$1_DRIVER) $(SCENE_$1_DRIVEN)),$(SCENE_$1_GEARS))
# $(call named,option,scene,artifact): once for each gear
named = $(foreach g,$(call gears_of,$2),$1 $g=out/$2/$g/$3.h5)
bodies_of = $(sort $(foreach g,$(call gears_of,$1),out/bodies/$(SCENE_$1_BODY_$g)/body.h5))
reference_static = out/$1/T$(SCENE_$1_REFERENCE_TORQUE)/static.h5

# What TORQUE is of, with the damping ratio DAMPING in the contact state STATE (one, two, mean), the phase PHASE, the ramp RATE, WAY.
DAMPING ?= 0.07
STATE ?= two
TORQUE ?= $(if $(SCENE),$(SCENE_$(own_scene)_REFERENCE_TORQUE),150)
PHASE ?= 0.25
# Without AT and with RATE: the sound of a run-up, then of a run-down.
sound_of_runup := $(if $(AT),,$(if $(RATE),$(filter sound,$(goals))))
RATE ?=
WAY ?= up
# The rate (rpm/s) stands in the path, and the ends of the ramp (Hz) where they are not the scene's: runup_100.h5,
# runup_100_2400_2800.h5.
runup_stem = $(RATE)$(if $(FROM),_$(FROM)_$(TO))

# Of maps of jumps (maps.mk).
JUMP_MAP_TORQUES ?= $(if $(SCENE),$(SCENE_$(own_scene)_TORQUES),20 50 100 150 200 300 450 600)
fineness = $(if $(filter fine,$($1)),_fine)
map_torques := $(if $(SCENE),$(JUMP_MAP_TORQUES),$(if $(call fineness,JUMP_MAP),20 35 50 75 100 125 150 175 200 250 300 350 400 450 500 600,$(JUMP_MAP_TORQUES)))

# Scenes by their kind. Torques that have rules: of a pair those that it lists and those in the paths of goals and figures, of a train that
# of its input.
of_kind = $(foreach s,$(scenes),$(if $(filter $1,$(SCENE_$s_KIND)),$s))
pairs := $(call of_kind,pair)
trains := $(call of_kind,train)
paths_of_pairs := $(foreach s,$(pairs),$(filter out/$s/%,$(path_goals)))
figure_torques := $(goals) $(figure_inputs)
torques = $(sort $(SCENE_$1_TORQUES) $(SCENE_$1_REFERENCE_TORQUE) $(patsubst T%,%,$(foreach f,$(filter out/$1/T%,$(figure_torques)),$(word 3,$(subst /, ,$f)))) \
  $(if $(filter $1,$(own_scene)),$(if $(filter calibrate loaded histories sound runup sensitivity fold-curves,$(goals)),$(TORQUE)) $(if $(findstring jump-map,$(goals)),$(map_torques))))
pair_places := $(foreach s,$(pairs),$(foreach t,$(call torques,$s),out/$s/T$t))
places := $(pair_places) $(foreach s,$(trains),out/$s/T$(SCENE_$s_TORQUES))
moving := $(foreach p,$(places),$(if $(filter yes,$(SCENE_$(word 2,$(subst /, ,$p))_MOVES)),$p))
ways := $(foreach p,$(moving),$p/up $p/down)
$(foreach s,$(trains),$(foreach g,$(filter out/$s/T%,$(path_goals)),$(if $(filter out/$s/T$(SCENE_$s_TORQUES)/%,$g),,\
  $(error $g: torques of a train are those of its drives$(,) so the results of $s lie in out/$s/T$(SCENE_$s_TORQUES)))))

# Lumped models, out/<scene>/T<torque>/<model>/; what stands after a dash is a variant. The rectangular wave is P2000's: the
# same at all torques.
lumped_models := rectangular rectangular-fig15 secant tangent pairs pairs-hertz
lumped_options_pairs-hertz = --hertz
lumped_options_rectangular = --reference-static $(reference_static)
# P2000's Fig. 15 shows the upper branch at 2200 Hz and the lower one at 2150 Hz. With the levels of the statics, or those
# of its Table 1, whose ratio is 1.5, the upper branch ends above 2600 Hz; this ratio of 1.757 at its mean stiffness of
# 462.1 N/µm ends it at 2172 Hz.
lumped_options_rectangular-fig15 = --levels 2.93973e8,5.16658e8 --duty 0.755 --from 2000 --to 3400 --step 10 --steps 512
# P2000's mass goes with the secant stiffness of its pair, the inertia of its scenes with the elastic body.
lumped_mass = $(if $(filter $(paper_scenes),$1),--mass 1.4)
# $(call lumped_options,scene,model)
lumped_options = --model $(firstword $(subst -, ,$2)) $(lumped_mass) $(lumped_options_$2)
lumped := $(foreach p,$(pair_places),$(foreach m,$(lumped_models),$p/$m/up $p/$m/down))

# Options that stand in the makefiles, in files of their own that are made again if they say otherwise: so that other options
# redo what they made. build/plans/<scene>/<name> holds $(plan_<name>), or what is of its kind.
plan_scene = $(notdir $(patsubst %/,%,$(@D)))
plan_text = $(strip $(or $(plan_$(@F)),$(if $(filter lumped_%,$(@F)),$(call lumped_options,$(plan_scene),$(@F:lumped_%=%))),$(plan_of_figure),$(plan_of_map)))
plans := $(foreach s,$(pairs),$(lumped_models:%=$(B)/plans/$s/lumped_%))
write_plan = @mkdir -p $(@D); echo '$1' > $(call new,$@); mv $(call new,$@) $@

out_bodies := $(addprefix out/bodies/,$(sort $(BODIES)))
$(out_bodies:%=%/mesh.h5): %/mesh.h5: %/body.toml $(call id,gear-mesh) | $(B)/bin/gear-mesh
	$(call run,mesh) --params $< --output $@ $(call landed,mesh)
$(out_bodies:%=%/body.h5): %/body.h5: %/body.toml %/mesh.h5 $(call id,gear-reduce) | $(B)/bin/gear-reduce
	$(call run,reduce) --params $< --mesh $(@D)/mesh.h5 --output $@ $(call landed,reduce)

# The same files, seen through the links out/<scene>/<gear>.
gears := $(foreach s,$(scenes),$(foreach g,$(SCENE_$s_GEARS),out/$s/$g))
$(gears:%=%/mesh.h5) $(gears:%=%/body.h5): out/bodies/$$(SCENE_$$(scene)_BODY_$$(call part,3))/$$(@F) ;

$(places:%=%/static.h5) $(places:%=%/error_budget.h5): $$(call params,static) $$(bodies) $(call id,gear-static) | $(B)/bin/gear-static
	$(call run,static)$(if $(filter %/error_budget.h5,$@), --error-budget) --params $< $(by_gear) $(if $(call is_pair,$(scene)),--torque $(torque) )--output $@ $(call landed,static)

systems := $(trains) $(call of_kind,rigid)
$(systems:%=out/%/modes.h5): $$(if $$(SCENE_$$(scene)_GEARS),$$(first_static),$$(call params,modes)) $(call id,gear-modes) | $(B)/bin/gear-modes
	$(call run,modes) $(if $(filter %.h5,$<),--static,--params) $< --output $@ $(call landed,modes)

$(moving:%=%/impact.h5): $$(call params,impact) $$(bodies) $$(at_rest) $(call id,gear-impact) | $(B)/bin/gear-impact
	$(call run,impact) --params $< $(by_static) --output $@ $(call landed,impact)

sweep_inputs = $(call params,sweep) $(bodies) $(at_rest)
# jumps.h5: the sweep with its jumps enclosed to 0.05 Hz, for `jump-folds`: a quarter more CPU.
sweep_options = $(if $(filter %/jumps.h5,$@), --jump-width 0.05)$(if $(filter %/sweep_errors.h5,$@), --errors)
$(ways:%=%/sweep.h5) $(ways:%=%/jumps.h5) $(ways:%=%/sweep_errors.h5): $$(sweep_inputs) $(call id,gear-sweep) | $(B)/bin/gear-sweep
	$(call run,sweep) --params $< $(by_static) --direction $(notdir $(@D))$(sweep_options) --output $@ $(call landed,sweep)

$(moving:%=%/branch.h5): $$(sweep_inputs) $(call id,gear-orbit) | $(B)/bin/gear-orbit
	$(call run,orbit) --params $< $(by_static) --output $@ $(call landed,orbit)

runups := $(foreach w,up down,$(if $(filter runup sound,$(goals)),$(foreach r,$(runup_stem) $(if $(FROM),$(RATE)_$(TO)_$(FROM)),out/$(own_scene)/T$(TORQUE)/$w/runup_$r.h5)))
ramp = $(subst _, ,$(patsubst runup_%,%,$(basename $(@F))))
$(sort $(runups) $(foreach g,$(path_goals),$(if $(findstring /runup_,$g),$g))): $$(sweep_inputs) $(call id,gear-runup) | $(B)/bin/gear-runup
	$(call run,runup) --params $< $(by_static) --direction $(notdir $(@D)) --rate '$(word 1,$(ramp))' $(if $(word 2,$(ramp)),--from '$(word 2,$(ramp))' --to '$(word 3,$(ramp))') --output $@ $(call landed,runup)

# The phase stands in the path, as the torque does: loaded_0.25.h5.
loaded_file := $(if $(filter loaded,$(goals)),out/$(own_scene)/T$(TORQUE)/loaded_$(PHASE).h5)
$(sort $(loaded_file) $(foreach g,$(paths_of_pairs),$(if $(findstring /loaded_,$g),$g))): $$(at)/static.h5 $$(bodies) $$(patsubst %/body.h5,%/mesh.h5,$$(bodies)) $(call id,gear-loaded) | $(B)/bin/gear-loaded
	$(call run,loaded) --static $< $(by_gear) $(call named,--mesh,$(scene),mesh) --mesh-phase $(patsubst loaded_%.h5,%,$(@F)) --output $@ $(call landed,loaded)

$(lumped:%=%/sweep.h5): $$(call params,lumped) $$(at)/static.h5 $$(if $$(filter rectangular,$$(call part,4)),$$(first_static)) \
    $(B)/plans/$$(scene)/lumped_$$(call part,4) $(call id,gear-lumped) | $(B)/bin/gear-lumped
	$(call run,lumped) $(call lumped_options,$(scene),$(call part,4)) --static $(at)/static.h5 --params $< --direction $(call part,5) --output $@ $(call landed,lumped)

$(addsuffix /response.h5,$(ways) $(lumped)): %/response.h5: %/sweep.h5 $(call id,gear-spectra) | $(B)/bin/gear-spectra
	$(B)/bin/gear-spectra --input $< --output $@

.PHONY: mesh reduce static loaded impact calibrate sweep branches lumped modes mode-shapes
# $(call at_torques,files): at all torques of SCENE; $(call drawn,figures): of a train, in its report; $(call drawn_in_motion,figures): of
# whatever moves
at_torques = $(foreach f,$1,$(SCENE_$(own_scene)_TORQUES:%=out/$(own_scene)/T%/$f.h5))
drawn = $(if $(filter train,$(SCENE_$(own_scene)_KIND)),$(call report_figure,$(own_scene),$1))
drawn_in_motion = $(if $(SCENE_$(own_scene)_TORQUES),$(call report_figure,$(own_scene),$1))
mesh: $(foreach g,$(SCENE_$(own_scene)_GEARS),out/$(own_scene)/$g/mesh.h5) ## mesh every gear of SCENE (default: the paper's)
reduce: $(foreach g,$(SCENE_$(own_scene)_GEARS),out/$(own_scene)/$g/body.h5) ## modes and flexibility of every gear of SCENE
static: $(call at_torques,static) $(call drawn,system-static) ## transmission error and stiffness, all torques of SCENE; of a train also load sharing and bearing forces, out/<scene>/report/system-static.png
loaded: $(loaded_file) ## both gears loaded and deformed, with contact pressure and stresses, for ParaView: PHASE=0.25 (0 up to 1) TORQUE=150
impact: $(call at_torques,impact) $(call drawn_in_motion,ring-down) ## natural frequency and damping by ring-down, all torques of SCENE, of a train of each mode; out/<scene>/report/ring-down.png
calibrated := $(if $(filter calibrate,$(goals)),$(patsubst %,out/$(own_scene)/T%/static.h5,$(TORQUE)))
calibrate: $(if $(calibrated),out/$(own_scene)/params/impact.toml $(call bodies_of,$(own_scene)) $(calibrated) $(call reference_static,$(own_scene))) | $(B)/bin/gear-impact ## print the rayleigh_stiffness_s that gives a damping ratio by ring-down: DAMPING=0.07 TORQUE=150 STATE=two
	@$| --params $< $(call named,--body,$(own_scene),body) --static $(calibrated) --reference-static $(call reference_static,$(own_scene)) --calibrate $(DAMPING) --contact-state $(STATE)
sweep: $(call at_torques,up/response down/response) $(call drawn,system-sweep) ## speed sweeps, all torques of SCENE; of a train with the forces on bearings, out/<scene>/report/system-sweep.png
branches: $(call at_torques,branch) $(call drawn_in_motion,branch) ## branches of periodic orbits, stable or not, with their folds, all torques of SCENE; over both sweeps of the first, out/<scene>/report/branch.png
lumped: $(call at_torques,$(foreach m,$(filter-out %-fig15,$(lumped_models)),$m/up/response $m/down/response)) ## speed sweeps of the lumped models, one degree of freedom, all torques of SCENE
modes_scene := $(if $(SCENE),$(own_scene),$(system_scene))
modes: out/$(modes_scene)/modes.h5 $(call report_figure,$(modes_scene),modes campbell) ## natural frequencies and mode shapes of a train, SCENE (default: a planetary train of rigid gears), out/<scene>/report/modes.png, and a Campbell diagram, campbell.png
mode-shapes: out/$(modes_scene)/modes.h5 ## the gears of a train moved by each natural mode, for ParaView, SCENE (default: a planetary train of rigid gears), out/<scene>/modes.hdf
	$(call stands,mode-shapes: open $(<:.h5=.hdf) in ParaView$(,) choose the array of a mode in Warp By Vector)

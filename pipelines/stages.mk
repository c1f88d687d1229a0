# Stages: scene -> mesh.h5 -> body.h5 -> static.h5 -> sweep.h5 -> response.h5, static.h5 -> impact.h5, and
# static.h5 -> sweep.h5 of a lumped model -> response.h5.
#
# A stage depends on the stage parameters that it reads, on the artifacts that it reads, and on the id of its
# program. Bodies are per distinct gear (out/bodies/<hash>), operating points are targets: the torque stands in the path.

# $(call run,stage): how a stage starts; LAUNCH may carry the heavy ones to other machines.
launch = $(or $(LAUNCH_$1),$(LAUNCH))
run = $(if $(call launch,$1),$(call launch,$1) )$(B)/bin/gear-$1

# $(call landed,stage): behind it. A launcher that has ended well without its program having run ends the recipe, also where an
# earlier file is still there; a file that another machine has written may be seen late, so it is waited for, in seconds.
LAUNCH_WAIT ?= 60
landed = $(if $(call launch,$1),&& { for second in $$(seq 0 $(LAUNCH_WAIT)); do \
  fresh=yes; for input in $^; do [ -e $@ ] && [ ! $$input -nt $@ ] || fresh=; done; [ -z "$$fresh" ] || exit 0; [ $$second = $(LAUNCH_WAIT) ] || sleep 1; done; \
  echo "$@: the launcher '$(call launch,$1)' has ended$(,) but its result is not there after $(LAUNCH_WAIT) s" >&2; exit 1; })

define body_rules # hash
out/bodies/$1/mesh.h5: out/bodies/$1/body.toml $(call id,gear-mesh) | $(B)/bin/gear-mesh
	$$(call run,mesh) --params $$< --output $$@ $$(call landed,mesh)

out/bodies/$1/body.h5: out/bodies/$1/body.toml out/bodies/$1/mesh.h5 $(call id,gear-reduce) | $(B)/bin/gear-reduce
	$$(call run,reduce) --params $$< --mesh out/bodies/$1/mesh.h5 --output $$@ $$(call landed,reduce)
endef

define gear_rules # scene, gear: the same files, seen through the link out/<scene>/<gear>
out/$1/$2/mesh.h5: out/bodies/$(SCENE_$1_BODY_$2)/mesh.h5 ;
out/$1/$2/body.h5: out/bodies/$(SCENE_$1_BODY_$2)/body.h5 ;
endef

pair_bodies = $(sort $(foreach g,$(SCENE_$1_DRIVER) $(SCENE_$1_DRIVEN),out/bodies/$(SCENE_$1_BODY_$g)/body.h5))
# $(call named,option,scene,artifact): once for each gear
named = $(foreach g,$(SCENE_$2_DRIVER) $(SCENE_$2_DRIVEN),$1 $g=out/$2/$g/$3.h5)
pair_options = $(call named,--body,$1,body)
reference_static = out/$1/T$(SCENE_$1_REFERENCE_TORQUE)/static.h5

define static_rules # scene, torque
out/$1/T$2/static.h5: out/$1/params/static.toml $(pair_bodies) $(call id,gear-static) | $(B)/bin/gear-static
	$$(call run,static) --params $$< $(pair_options) --torque $2 --output $$@ $$(call landed,static)
endef

define budget_rules # scene, torque
out/$1/T$2/error_budget.h5: out/$1/params/static.toml $(pair_bodies) $(call id,gear-static) | $(B)/bin/gear-static
	$$(call run,static) --error-budget --params $$< $(pair_options) --torque $2 --output $$@ $$(call landed,static)
endef

impact_inputs = out/$1/params/impact.toml $(pair_bodies) out/$1/T$2/static.h5 $(reference_static)
impact_options = --params out/$1/params/impact.toml $(pair_options) --static out/$1/T$2/static.h5 --reference-static $(reference_static)

define impact_rules # scene, torque
out/$1/T$2/impact.h5: $(impact_inputs) $(call id,gear-impact) | $(B)/bin/gear-impact
	$$(call run,impact) $(impact_options) --output $$@ $$(call landed,impact)
endef

define sweep_rules # scene, torque, direction
out/$1/T$2/$3/sweep.h5: out/$1/params/sweep.toml $(pair_bodies) \
    out/$1/T$2/static.h5 $(reference_static) $(call id,gear-sweep) | $(B)/bin/gear-sweep
	$$(call run,sweep) --params $$< $(pair_options) --static out/$1/T$2/static.h5 \
	  --reference-static $(reference_static) --direction $3 --output $$@ $$(call landed,sweep)

out/$1/T$2/$3/response.h5: out/$1/T$2/$3/sweep.h5 $(call id,gear-spectra) | $(B)/bin/gear-spectra
	$(B)/bin/gear-spectra --input $$< --output $$@
endef

# The sweep with its jumps enclosed to 0.05 Hz, for `jump-folds`: a quarter more CPU.
jump_width := 0.05
define jumps_rules # scene, torque, direction
out/$1/T$2/$3/jumps.h5: out/$1/params/sweep.toml $(pair_bodies) \
    out/$1/T$2/static.h5 $(reference_static) $(call id,gear-sweep) | $(B)/bin/gear-sweep
	$$(call run,sweep) --params $$< $(pair_options) --static out/$1/T$2/static.h5 \
	  --reference-static $(reference_static) --direction $3 --jump-width $(jump_width) --output $$@ $$(call landed,sweep)
endef

define branch_rules # scene, torque
out/$1/T$2/branch.h5: out/$1/params/sweep.toml $(pair_bodies) \
    out/$1/T$2/static.h5 $(reference_static) $(call id,gear-orbit) | $(B)/bin/gear-orbit
	$$(call run,orbit) --params $$< $(pair_options) --static out/$1/T$2/static.h5 \
	  --reference-static $(reference_static) --output $$@ $$(call landed,orbit)
endef

# The rate (rpm/s) stands in the path, and the ends of the ramp (Hz) where they are not the scene's: runup_100.h5,
# runup_100_2400_2800.h5.
runup_word = $(word $2,$(subst _, ,$1))
define runup_rules # scene, torque, direction
out/$1/T$2/$3/runup_%.h5: out/$1/params/sweep.toml $(pair_bodies) \
    out/$1/T$2/static.h5 $(reference_static) $(call id,gear-runup) | $(B)/bin/gear-runup
	$$(call run,runup) --params $$< $(pair_options) --static out/$1/T$2/static.h5 \
	  --reference-static $(reference_static) --direction $3 --rate '$$(call runup_word,$$*,1)' \
	  $$(if $$(call runup_word,$$*,2),--from '$$(call runup_word,$$*,2)' --to '$$(call runup_word,$$*,3)') --output $$@ $$(call landed,runup)
endef

# The phase stands in the path, as the torque does: loaded_0.25.h5.
pair_meshes = $(patsubst %/body.h5,%/mesh.h5,$(pair_bodies))
define loaded_rules # scene, torque
out/$1/T$2/loaded_%.h5: out/$1/T$2/static.h5 $(pair_bodies) $(pair_meshes) $(call id,gear-loaded) | $(B)/bin/gear-loaded
	$$(call run,loaded) --static out/$1/T$2/static.h5 $(pair_options) $(call named,--mesh,$1,mesh) \
	  --mesh-phase $$* --output $$@ $$(call landed,loaded)
endef

# Options that stand in the makefiles, in files of their own that are made again if they say otherwise: so that other options
# redo what they made. $(call plan_rule,file,options). $(strip): make 4.3 leaves the newline of $(file <...) where its buffer has moved.
define plan_rule
$1: $(if $(filter xx,x$(call differs,$(strip $(file <$1)),$(strip $2))x),,FORCE)
	@mkdir -p $$(@D); echo '$(strip $2)' > $$@.new.$$$$$$$$; mv $$@.new.$$$$$$$$ $$@
endef
differs = $(if $(and $(findstring x$1x,x$2x),$(findstring x$2x,x$1x)),,differs)

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

lumped_plan = --model $(firstword $(subst -, ,$3)) $(lumped_mass) $(lumped_options_$3)
lumped_plan_file = $(B)/plans/$1/lumped_$3

define lumped_rules # scene, torque, model, direction
out/$1/T$2/$3/$4/sweep.h5: out/$1/params/lumped.toml out/$1/T$2/static.h5 $(if $(filter rectangular,$3),$(reference_static)) \
    $(lumped_plan_file) $(call id,gear-lumped) | $(B)/bin/gear-lumped
	$$(call run,lumped) $(lumped_plan) --static out/$1/T$2/static.h5 --params $$< --direction $4 --output $$@ $$(call landed,lumped)

out/$1/T$2/$3/$4/response.h5: out/$1/T$2/$3/$4/sweep.h5 $(call id,gear-spectra) | $(B)/bin/gear-spectra
	$(B)/bin/gear-spectra --input $$< --output $$@
endef

# What eta gives the damping ratio DAMPING in the contact state STATE (one, two, mean) at TORQUE.
DAMPING ?= 0.07
STATE ?= two
TORQUE ?= $(if $(SCENE),$(SCENE_$(own_scene)_REFERENCE_TORQUE),150)
PHASE ?= 0.25
# $(call outside,number,least,limit): a word if it is no number of [least, limit)
outside = $(shell awk -v x='$(subst ','\'',$1)' 'BEGIN { if (x !~ /^[0-9]*[.]?[0-9]+([eE][-+]?[0-9]+)?$$/ || x + 0 < $2 || x + 0 >= $3) print "outside" }')
$(if $(filter calibrate,$(goals)),$(if $(call outside,$(DAMPING),1e-12,1),\
  $(error DAMPING=$(DAMPING): it is a share of critical damping, above 0 and below 1: 0.05 for 5 %)))
$(if $(filter histories,$(goals)),$(if $(call outside,$(AT),1e-9,1e9),\
  $(error histories: AT=$(AT): say the mesh frequency in Hz$(,) one of the sweep: make histories AT=1250)))
$(if $(filter sound,$(goals)),$(if $(filter runup,$(goals)),,$(if $(AT),$(if $(RATE),\
  $(error sound: AT=$(AT) and RATE=$(RATE): a sound is of one speed (AT) or of a run-up (RATE); leave one of them out)))))
# Without AT and with RATE: the sound of a run-up, then of a run-down.
sound_of_runup := $(if $(AT),,$(if $(RATE),$(filter sound,$(goals))))
$(if $(filter sound,$(goals)),$(if $(sound_of_runup),,$(if $(call outside,$(AT),1e-9,1e9),\
  $(error sound: AT=$(AT): say the mesh frequency in Hz$(,) one of the sweep: make sound AT=2400$(,) or the rate of a run-up in rpm/s: make sound RATE=100))))
ramp_goals := $(filter runup,$(goals)) $(sound_of_runup)
RATE ?= 100
WAY ?= up
$(if $(strip $(ramp_goals)),$(if $(call outside,$(RATE),1e-9,1e9),\
  $(error RATE=$(RATE): it is the change of the driver's speed in rpm/s$(,) above 0; WAY=down is a run-down)))
$(if $(filter runup,$(goals)),$(if $(filter up down,$(WAY)),,$(error WAY=$(WAY): it is up or down)))
$(if $(strip $(ramp_goals)),$(if $(FROM)$(TO),$(if $(call outside,$(FROM),1e-9,1e9)$(call outside,$(TO),1e-9,1e9),\
  $(error FROM=$(FROM) TO=$(TO): give both or none: mesh frequencies in Hz at the start and the end of the ramp))))
runup_stem = $(RATE)$(if $(FROM),_$(FROM)_$(TO))
$(if $(filter loaded,$(goals)),$(if $(filter alike,$(SCENE_$(own_scene)_TEETH)),$(if $(call outside,$(PHASE),0,1),\
  $(error PHASE=$(PHASE): it is a share of the mesh period, 0 up to, not including, 1))))
calibrated_torque = $(if $(filter calibrate loaded histories sound runup,$(goals)),$(if $(filter $1,$(own_scene)),$(TORQUE)))

# Torques of a scene that have rules: those that it lists and those in the paths of goals and figures.
path_torques = $(patsubst T%,%,$(foreach f,$(filter out/$1/T%,$(goals) $(figure_inputs)),$(word 3,$(subst /, ,$f))))
torques = $(sort $(SCENE_$1_TORQUES) $(SCENE_$1_REFERENCE_TORQUE) $(path_torques) $(calibrated_torque))
check_torque = $(if $(filter-out $2,$(shell LC_ALL=C printf %g '$2' 2>/dev/null || echo no number)),\
  $(error out/$1/T$2: the torque in a path is a number in N m as printed by %g, such as T150 or T62.5))

define scene_rules # scene
$(foreach g,$(SCENE_$1_GEARS),$(eval $(call gear_rules,$1,$g)))
$(foreach t,$(filter-out $(SCENE_$1_TORQUES),$(sort $(path_torques) $(calibrated_torque))),$(call check_torque,$1,$t))
$(foreach m,$(lumped_models),$(eval $(call plan_rule,$(call lumped_plan_file,$1,,$m),$(call lumped_plan,$1,,$m))))
$(foreach t,$(torques),$(eval $(call static_rules,$1,$t))$(eval $(call budget_rules,$1,$t))$(eval $(call impact_rules,$1,$t))$(eval $(call loaded_rules,$1,$t))$(eval $(call branch_rules,$1,$t))\
  $(foreach d,up down,$(eval $(call sweep_rules,$1,$t,$d))$(eval $(call jumps_rules,$1,$t,$d))$(eval $(call runup_rules,$1,$t,$d))\
    $(foreach m,$(lumped_models),$(eval $(call lumped_rules,$1,$t,$m,$d)))))
$(call figure_rules,$1)
endef

$(foreach h,$(sort $(BODIES)),$(eval $(call body_rules,$h)))
$(foreach s,$(scenes),$(if $(SCENE_$s_GEARS),$(eval $(call scene_rules,$s))))

.PHONY: mesh reduce static loaded impact calibrate sweep branches lumped
mesh: $(foreach g,$(SCENE_$(own_scene)_GEARS),out/$(own_scene)/$g/mesh.h5) ## mesh every gear of SCENE (default: the paper's)
reduce: $(foreach g,$(SCENE_$(own_scene)_GEARS),out/$(own_scene)/$g/body.h5) ## modes and flexibility of every gear of SCENE
static: $(SCENE_$(own_scene)_TORQUES:%=out/$(own_scene)/T%/static.h5) ## transmission error and stiffness, all torques of SCENE
loaded: $(if $(filter loaded,$(goals)),out/$(own_scene)/T$(TORQUE)/loaded_$(PHASE).h5) ## both gears loaded and deformed, with contact pressure and stresses, for ParaView: PHASE=0.25 (0 up to 1) TORQUE=150
impact: $(SCENE_$(own_scene)_TORQUES:%=out/$(own_scene)/T%/impact.h5) ## natural frequency and damping by ring-down, all torques of SCENE
calibrate: $(if $(filter calibrate,$(goals)),$(call impact_inputs,$(own_scene),$(TORQUE))) | $(B)/bin/gear-impact ## print the rayleigh_stiffness_s that gives a damping ratio by ring-down: DAMPING=0.07 TORQUE=150 STATE=two
	@$| $(call impact_options,$(own_scene),$(TORQUE)) --calibrate $(DAMPING) --contact-state $(STATE)
sweep: $(foreach d,up down,$(SCENE_$(own_scene)_TORQUES:%=out/$(own_scene)/T%/$d/response.h5)) ## speed sweeps, all torques of SCENE
branches: $(SCENE_$(own_scene)_TORQUES:%=out/$(own_scene)/T%/branch.h5) ## branches of periodic orbits, stable or not, with their folds, all torques of SCENE
lumped: $(foreach m,$(filter-out %-fig15,$(lumped_models)),$(foreach d,up down,$(SCENE_$(own_scene)_TORQUES:%=out/$(own_scene)/T%/$m/$d/response.h5))) ## speed sweeps of the lumped models, one degree of freedom, all torques of SCENE

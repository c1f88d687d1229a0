# Systems: scenes of several meshes, carriers or drives. Rigid gears: their scene -> modes.h5. Elastic gears: scene and bodies ->
# system_static.h5 -> modes.h5; with [operation] also {up,down}/system_sweep.h5 -> response.h5, system_impact.h5, system_branch.h5. Both: the page of these.
#
# A figure of another stage is a row of inputs_of_<figure> with its name in system_shows, and a row in
# common/report/system_report.cpp.

systems_that = $(foreach s,$(scenes),$(if $(filter $2,$(SCENE_$s_$1)),$s))
rigid := $(call systems_that,SYSTEM,rigid)
elastic := $(call systems_that,SYSTEM,elastic)
moving := $(call systems_that,SYSTEM_MOVES,yes)

$(rigid:%=out/%/modes.h5): out/%/modes.h5: out/%/params/system.toml $(call id,gear-modes) | $(B)/bin/gear-modes
	$(call run,modes) --params $< --output $@ $(call landed,modes)
$(elastic:%=out/%/modes.h5): out/%/modes.h5: out/%/system_static.h5 $(call id,gear-modes) | $(B)/bin/gear-modes
	$(call run,modes) --static $< --output $@ $(call landed,modes)

system_bodies = $(sort $(foreach g,$(SCENE_$(scene)_SYSTEM_GEARS),out/bodies/$(SCENE_$(scene)_BODY_$g)/body.h5))
by_system_gear = $(foreach g,$(SCENE_$(scene)_SYSTEM_GEARS),--body $g=out/$(scene)/$g/body.h5)
$(elastic:%=out/%/system_static.h5): $$(call params,system_static) $$(system_bodies) $(call id,gear-system-static) | $(B)/bin/gear-system-static
	$(call run,system-static) --params $< $(by_system_gear) --output $@ $(call landed,system-static)
$(foreach w,up down,$(moving:%=out/%/$w/system_sweep.h5)): $$(call params,system_sweep) $$(system_bodies) $(call id,gear-system-sweep) | $(B)/bin/gear-system-sweep
	$(call run,system-sweep) --params $< $(by_system_gear) --direction $(call part,3) --output $@ $(call landed,system-sweep)
$(foreach w,up down,$(moving:%=out/%/$w/response.h5)): %/response.h5: %/system_sweep.h5 $(call id,gear-spectra) | $(B)/bin/gear-spectra
	$(B)/bin/gear-spectra --input $< --output $@
motion_program = $(patsubst system_%,system-%,$(patsubst system_branch,system_orbit,$(basename $(@F))))
$(foreach f,impact branch,$(moving:%=out/%/system_$f.h5)): $$(call params,system_sweep) $$(system_bodies) $$(call id,gear-$$(motion_program)) | $(B)/bin/gear-system-impact $(B)/bin/gear-system-orbit
	$(call run,$(motion_program)) --params $< $(by_system_gear) --output $@ $(call landed,$(motion_program))

# $1 scene: figures of its report, and what each is drawn from
has_planets = $(and $(filter elastic,$(SCENE_$1_SYSTEM)),$(filter yes,$(SCENE_$1_PLANETS)))
system_shows = system $(if $(filter elastic,$(SCENE_$1_SYSTEM)),system-static) $(if $(call has_planets,$1),load-sharing) modes campbell $(if $(SCENE_$1_SYSTEM_MOVES),system-sweep order-cuts)
inputs_of_system = $(if $(filter elastic,$(SCENE_$1_SYSTEM)),$(inputs_of_system-static),$(inputs_of_modes))
inputs_of_system-static = out/$1/system_static.h5
inputs_of_load-sharing = out/$1/system_static.h5
inputs_of_modes = out/$1/modes.h5
inputs_of_campbell = out/$1/modes.h5
inputs_of_system-sweep = $(foreach w,up down,out/$1/$w/response.h5)
inputs_of_order-cuts = $(inputs_of_system-sweep)
inputs_of_system-ringdown = out/$1/system_impact.h5
inputs_of_system-branch = out/$1/system_branch.h5 $(inputs_of_system-sweep)
system_artifacts = $(if $(filter elastic,$(SCENE_$1_SYSTEM)),out/$1/system_static.h5) out/$1/modes.h5 $(if $(SCENE_$1_SYSTEM_MOVES),$(inputs_of_system-sweep))
# Load sharing of a pair is among its teeth.
drawn_of_system = $(if $(filter load-sharing,$1),system-load-sharing,$1)

modes_scene := $(if $(SCENE),$(own_scene),$(system_scene))
elastic_scene := $(if $(SCENE),$(own_scene),$(elastic_system_scene))
# $(call drawn,scene,figures): of its report
drawn = $(foreach f,$2,$(foreach e,tsv svg png,out/$1/report/$f.$e))

.PHONY: modes mode-shapes system-static $(motion_goals)
modes: out/$(modes_scene)/modes.h5 $(call drawn,$(modes_scene),modes campbell) ## natural frequencies and mode shapes of a system, SCENE (default: a planetary train of rigid gears), out/<scene>/report/modes.png, and a Campbell diagram, campbell.png
system-static: out/$(elastic_scene)/system_static.h5 $(call drawn,$(elastic_scene),system-static) ## a system of elastic gears at rest, SCENE (default: a planetary train): transmission errors, load sharing, bearing forces, out/<scene>/report/system-static.png
system-sweep: $(foreach w,up down,out/$(elastic_scene)/$w/response.h5) $(call drawn,$(elastic_scene),system-sweep) ## a system of elastic gears over its speeds, SCENE (default: a planetary train): vibration and contact loss of each mesh, forces on bearings, out/<scene>/report/system-sweep.png
system-ringdown: out/$(elastic_scene)/system_impact.h5 $(call drawn,$(elastic_scene),system-ringdown) ## natural frequencies and damping ratios of the modes of a system at fixed mesh phases, SCENE (default: a planetary train), out/<scene>/report/system-ringdown.png
system-branch: out/$(elastic_scene)/system_branch.h5 $(call drawn,$(elastic_scene),system-branch) ## all periodic motions of a branch of a system, unstable ones too, over both sweeps, SCENE (default: a planetary train), out/<scene>/report/system-branch.png
mode-shapes: out/$(modes_scene)/modes.h5 ## the gears of a system moved by each natural mode, for ParaView, SCENE (default: a planetary train of rigid gears), out/<scene>/modes.hdf
	$(call stands,mode-shapes: open $(<:.h5=.hdf) in ParaView$(,) choose the array of a mode in Warp By Vector)

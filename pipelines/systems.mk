# Systems: scenes of several meshes, carriers or drives.
#
#   rigid gears    out/S/params/system.toml -> out/S/modes.h5 -> out/S/report/{system,modes,campbell}.png
#   elastic gears  out/S/params/system_static.toml and the bodies -> out/S/system_static.h5
#                  -> out/S/report/{system,system-static,load-sharing}.png, out/S/modes.h5 -> out/S/report/{modes,campbell}.png
#                  with [operation] out/S/params/system_sweep.toml and the bodies -> out/S/{up,down}/system_sweep.h5
#                  -> out/S/report/system-sweep.png, a part of the page
#                  likewise out/S/system_impact.h5 -> out/S/report/system-ringdown.png, out/S/system_branch.h5 and the sweeps
#                  -> out/S/report/system-branch.png
#   both           out/S/report/index.html, the page of these
#
# A figure of another stage is a row of inputs_of_<figure> with its name in system_shows, and a row in
# common/report/system_report.cpp.

define rigid_rules # scene
out/$1/modes.h5: out/$1/params/system.toml $(call id,gear-modes) | $(B)/bin/gear-modes
	$$(call run,modes) --params $$< --output $$@ $$(call landed,modes)
endef

system_bodies = $(sort $(foreach g,$(SCENE_$1_SYSTEM_GEARS),out/bodies/$(SCENE_$1_BODY_$g)/body.h5))
define system_sweep_rule # scene, up or down
out/$1/$2/system_sweep.h5: out/$1/params/system_sweep.toml $(system_bodies) $(call id,gear-system-sweep) | $(B)/bin/gear-system-sweep
	$$(call run,system-sweep) --params $$< $(foreach g,$(SCENE_$1_SYSTEM_GEARS),--body $g=out/$1/$g/body.h5) --direction $2 --output $$@ $$(call landed,system-sweep)
endef
define system_motion_rule # scene, file, program
out/$1/$2.h5: out/$1/params/system_sweep.toml $(system_bodies) $(call id,gear-$3) | $(B)/bin/gear-$3
	$$(call run,$3) --params $$< $(foreach g,$(SCENE_$1_SYSTEM_GEARS),--body $g=out/$1/$g/body.h5) --output $$@ $$(call landed,$3)
endef
define elastic_rules # scene
$(foreach g,$(SCENE_$1_SYSTEM_GEARS),$(eval $(call gear_rules,$1,$g)))
out/$1/system_static.h5: out/$1/params/system_static.toml $(system_bodies) $(call id,gear-system-static) | $(B)/bin/gear-system-static
	$$(call run,system-static) --params $$< $(foreach g,$(SCENE_$1_SYSTEM_GEARS),--body $g=out/$1/$g/body.h5) --output $$@ $$(call landed,system-static)

out/$1/modes.h5: out/$1/system_static.h5 $(call id,gear-modes) | $(B)/bin/gear-modes
	$$(call run,modes) --static $$< --output $$@ $$(call landed,modes)
$(if $(SCENE_$1_SYSTEM_MOVES),$(foreach w,up down,$(eval $(call system_sweep_rule,$1,$w)))\
  $(eval $(call system_motion_rule,$1,system_impact,system-impact))$(eval $(call system_motion_rule,$1,system_branch,system-orbit))\
  $(eval $(call figure_rule,system-ringdown,out/$1/report/system-ringdown,out/$1/system_impact.h5))\
  $(eval $(call figure_rule,system-branch,out/$1/report/system-branch,out/$1/system_branch.h5 $(foreach w,up down,out/$1/$w/system_sweep.h5))))
endef

# $1 scene: figures of its report, and what each is drawn from
has_planets = $(and $(filter elastic,$(SCENE_$1_SYSTEM)),$(filter yes,$(SCENE_$1_PLANETS)))
system_shows = system $(if $(filter elastic,$(SCENE_$1_SYSTEM)),system-static) $(if $(call has_planets,$1),load-sharing) modes campbell $(if $(SCENE_$1_SYSTEM_MOVES),system-sweep order-cuts)
inputs_of_system = $(if $(filter elastic,$(SCENE_$1_SYSTEM)),$(inputs_of_system-static),$(inputs_of_modes))
inputs_of_system-static = out/$1/system_static.h5
inputs_of_load-sharing = out/$1/system_static.h5
inputs_of_modes = out/$1/modes.h5
inputs_of_campbell = out/$1/modes.h5
inputs_of_system-sweep = $(foreach w,up down,out/$1/$w/system_sweep.h5)
inputs_of_order-cuts = $(inputs_of_system-sweep)
system_artifacts = $(if $(filter elastic,$(SCENE_$1_SYSTEM)),out/$1/system_static.h5) out/$1/modes.h5 $(if $(SCENE_$1_SYSTEM_MOVES),$(inputs_of_system-sweep))
# Load sharing of a pair, among its teeth, has a template of its own.
drawn_of_system = $(if $(filter load-sharing,$1),system-load-sharing,$1)

define system_report_rule # scene
$(call together,out/$1/report/index.html out/$1/report/results.tsv) &: $(system_artifacts) $(patsubst %,out/$1/report/%.png,$(system_shows)) \
    out/$1/params/title.txt $(B)/scenes/$1.mk $(call id,gear-report) | $(B)/bin/gear-report
	$(B)/bin/gear-report --output out/$1/report/index.html $(system_artifacts) $(patsubst %,out/$1/report/%.png,$(system_shows))
endef

define system_rules # scene
$(eval $(call $(SCENE_$1_SYSTEM)_rules,$1))
$(foreach f,$(system_shows),$(eval $(call figure_rule,$(call drawn_of_system,$f),out/$1/report/$f,$(call inputs_of_$f,$1))))
$(eval $(call system_report_rule,$1))
endef
$(foreach s,$(scenes),$(if $(SCENE_$s_SYSTEM),$(eval $(call system_rules,$s))))

modes_scene := $(if $(SCENE),$(own_scene),$(system_scene))
elastic_scene := $(if $(SCENE),$(own_scene),$(elastic_system_scene))
# A fragment is empty until make has remade it, then make starts again.
motion_goals := system-sweep system-ringdown system-branch
system_goals := $(filter modes mode-shapes system-static $(motion_goals),$(goals))
$(if $(system_goals),$(if $(SCENE_$(modes_scene)_GEARS),\
  $(error SCENE=$(SCENE): it is a pair; $(if $(filter modes mode-shapes,$(goals)),modes are,$(firstword $(system_goals)) is) of systems$(,) scenes of several meshes$(,) carriers or drives)))
$(if $(filter system-static $(motion_goals),$(goals)),$(if $(filter rigid,$(SCENE_$(elastic_scene)_SYSTEM)),\
  $(error SCENE=$(SCENE): its gears are rigid; $(firstword $(filter system-static $(motion_goals),$(goals))) needs elastic ones$(,) for it there is: make SCENE=$(SCENE) modes)))
$(if $(filter $(motion_goals),$(goals)),$(if $(filter elastic,$(SCENE_$(elastic_scene)_SYSTEM)),$(if $(SCENE_$(elastic_scene)_SYSTEM_MOVES),,\
  $(error SCENE=$(SCENE): it says no speeds; write [operation] with mesh_frequency_Hz = { from = 500$(,) to = 5000$(,) step = 50 } into it))))
of_systems := report $(if $(call has_planets,$(own_scene)),load-sharing)
$(if $(SCENE_$(own_scene)_SYSTEM),$(if $(filter load-sharing,$(filter-out $(of_systems),$(goals))),\
  $(error load-sharing: SCENE=$(SCENE) $(if $(filter rigid,$(SCENE_$(own_scene)_SYSTEM)),has rigid gears$(,) of which there are natural modes alone,has no planets that share a load)$(,) use \
    make SCENE=$(SCENE) report)))
$(if $(SCENE_$(own_scene)_SYSTEM),$(foreach g,$(filter-out $(of_systems),$(filter $(pair_goals) figures teeth $(figures) table1 animation,$(goals))),\
  $(error $g: SCENE=$(SCENE) is a system of several meshes$(,) carriers or drives; for it there is: make SCENE=$(SCENE) report$(,) \
    or of it $(if $(filter elastic,$(SCENE_$(own_scene)_SYSTEM)),system-static $(if $(SCENE_$(own_scene)_SYSTEM_MOVES),$(motion_goals) ))modes)))

.PHONY: modes mode-shapes system-static $(motion_goals)
modes: out/$(modes_scene)/modes.h5 $(foreach f,modes campbell,$(foreach e,tsv svg png,out/$(modes_scene)/report/$f.$e)) ## natural frequencies and mode shapes of a system, SCENE (default: a planetary train of rigid gears), out/<scene>/report/modes.png, and a Campbell diagram, campbell.png
system-static: out/$(elastic_scene)/system_static.h5 $(foreach e,tsv svg png,out/$(elastic_scene)/report/system-static.$e) ## a system of elastic gears at rest, SCENE (default: a planetary train): transmission errors, load sharing, bearing forces, out/<scene>/report/system-static.png
system-sweep: $(foreach w,up down,out/$(elastic_scene)/$w/system_sweep.h5) $(foreach e,tsv svg png,out/$(elastic_scene)/report/system-sweep.$e) ## a system of elastic gears over its speeds, SCENE (default: a planetary train): vibration and contact loss of each mesh, forces on bearings, out/<scene>/report/system-sweep.png
system-ringdown: out/$(elastic_scene)/system_impact.h5 $(foreach e,tsv svg png,out/$(elastic_scene)/report/system-ringdown.$e) ## natural frequencies and damping ratios of the modes of a system at fixed mesh phases, SCENE (default: a planetary train), out/<scene>/report/system-ringdown.png
system-branch: out/$(elastic_scene)/system_branch.h5 $(foreach e,tsv svg png,out/$(elastic_scene)/report/system-branch.$e) ## all periodic motions of a branch of a system, unstable ones too, over both sweeps, SCENE (default: a planetary train), out/<scene>/report/system-branch.png
mode-shapes: out/$(modes_scene)/modes.h5 ## the gears of a system moved by each natural mode, for ParaView, SCENE (default: a planetary train of rigid gears), out/<scene>/modes.hdf
	$(call stands,mode-shapes: open $(<:.h5=.hdf) in ParaView$(,) choose the array of a mode in Warp By Vector)

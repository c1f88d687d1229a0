# Systems: scenes of several meshes, carriers or drives.
#
#   rigid gears    out/S/params/system.toml -> out/S/modes.h5 -> out/S/report/{modes,campbell}.png
#   elastic gears  out/S/params/system_static.toml and the bodies -> out/S/system_static.h5 -> out/S/report/system-static.png,
#                  out/S/modes.h5 -> out/S/report/{modes,campbell}.png
#                  with [operation] out/S/params/system_sweep.toml and the bodies -> out/S/{up,down}/system_sweep.h5
#                  -> out/S/report/system-sweep.png

define rigid_rules # scene
out/$1/modes.h5: out/$1/params/system.toml $(call id,gear-modes) | $(B)/bin/gear-modes
	$$(call run,modes) --params $$< --output $$@ $$(call landed,modes)
endef

system_bodies = $(sort $(foreach g,$(SCENE_$1_SYSTEM_GEARS),out/bodies/$(SCENE_$1_BODY_$g)/body.h5))
define system_sweep_rule # scene, up or down
out/$1/$2/system_sweep.h5: out/$1/params/system_sweep.toml $(system_bodies) $(call id,gear-system-sweep) | $(B)/bin/gear-system-sweep
	$$(call run,system-sweep) --params $$< $(foreach g,$(SCENE_$1_SYSTEM_GEARS),--body $g=out/$1/$g/body.h5) --direction $2 --output $$@ $$(call landed,system-sweep)
endef
define elastic_rules # scene
$(foreach g,$(SCENE_$1_SYSTEM_GEARS),$(eval $(call gear_rules,$1,$g)))
out/$1/system_static.h5: out/$1/params/system_static.toml $(system_bodies) $(call id,gear-system-static) | $(B)/bin/gear-system-static
	$$(call run,system-static) --params $$< $(foreach g,$(SCENE_$1_SYSTEM_GEARS),--body $g=out/$1/$g/body.h5) --output $$@ $$(call landed,system-static)

out/$1/modes.h5: out/$1/system_static.h5 $(call id,gear-modes) | $(B)/bin/gear-modes
	$$(call run,modes) --static $$< --output $$@ $$(call landed,modes)
$(eval $(call figure_rule,system-static,out/$1/report/system-static,out/$1/system_static.h5))
$(if $(SCENE_$1_SYSTEM_MOVES),$(foreach w,up down,$(eval $(call system_sweep_rule,$1,$w)))\
  $(eval $(call figure_rule,system-sweep,out/$1/report/system-sweep,$(foreach w,up down,out/$1/$w/system_sweep.h5))))
endef

define system_rules # scene
$(eval $(call $(SCENE_$1_SYSTEM)_rules,$1))
$(foreach f,modes campbell,$(eval $(call figure_rule,$f,out/$1/report/$f,out/$1/modes.h5)))
endef
$(foreach s,$(scenes),$(if $(SCENE_$s_SYSTEM),$(eval $(call system_rules,$s))))

modes_scene := $(if $(SCENE),$(own_scene),$(system_scene))
elastic_scene := $(if $(SCENE),$(own_scene),$(elastic_system_scene))
# A fragment is empty until make has remade it, then make starts again.
system_goals := $(filter modes system-static system-sweep,$(goals))
$(if $(system_goals),$(if $(SCENE_$(modes_scene)_GEARS),\
  $(error SCENE=$(SCENE): it is a pair; $(if $(filter modes,$(goals)),modes are,$(firstword $(system_goals)) is) of systems$(,) scenes of several meshes$(,) carriers or drives)))
$(if $(filter system-static system-sweep,$(goals)),$(if $(filter rigid,$(SCENE_$(elastic_scene)_SYSTEM)),\
  $(error SCENE=$(SCENE): its gears are rigid; $(firstword $(filter system-static system-sweep,$(goals))) needs elastic ones$(,) for it there is: make SCENE=$(SCENE) modes)))
$(if $(filter system-sweep,$(goals)),$(if $(filter elastic,$(SCENE_$(elastic_scene)_SYSTEM)),$(if $(SCENE_$(elastic_scene)_SYSTEM_MOVES),,\
  $(error SCENE=$(SCENE): it says no speeds; write [operation] with mesh_frequency_Hz = { from = 500$(,) to = 5000$(,) step = 50 } into it))))
$(if $(SCENE_$(own_scene)_SYSTEM),$(foreach g,$(filter $(pair_goals) figures teeth $(figures) table1 animation,$(goals)),\
  $(error $g: SCENE=$(SCENE) is a system of several meshes$(,) carriers or drives; for it there is: make SCENE=$(SCENE) \
    $(if $(filter elastic,$(SCENE_$(own_scene)_SYSTEM)),system-static $(if $(SCENE_$(own_scene)_SYSTEM_MOVES),system-sweep ))modes)))

.PHONY: modes system-static system-sweep
modes: out/$(modes_scene)/modes.h5 $(foreach f,modes campbell,$(foreach e,tsv svg png,out/$(modes_scene)/report/$f.$e)) ## natural frequencies and mode shapes of a system, SCENE (default: a planetary train of rigid gears), out/<scene>/report/modes.png, and a Campbell diagram, campbell.png
system-static: out/$(elastic_scene)/system_static.h5 $(foreach e,tsv svg png,out/$(elastic_scene)/report/system-static.$e) ## a system of elastic gears at rest, SCENE (default: a planetary train): transmission errors, load sharing, bearing forces, out/<scene>/report/system-static.png
system-sweep: $(foreach w,up down,out/$(elastic_scene)/$w/system_sweep.h5) $(foreach e,tsv svg png,out/$(elastic_scene)/report/system-sweep.$e) ## a system of elastic gears over its speeds, SCENE (default: a planetary train): vibration and contact loss of each mesh, forces on bearings, out/<scene>/report/system-sweep.png

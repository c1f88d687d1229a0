# Systems: scenes of several meshes, carriers or drives. out/S/params/system.toml -> out/S/modes.h5 -> out/S/report/modes.png

define system_rules # scene
out/$1/modes.h5: out/$1/params/system.toml $(call id,gear-modes) | $(B)/bin/gear-modes
	$$(call run,modes) --params $$< --output $$@ $$(call landed,modes)
$(eval $(call figure_rule,modes,out/$1/report/modes,out/$1/modes.h5))
endef
$(foreach s,$(scenes),$(if $(SCENE_$s_SYSTEM),$(eval $(call system_rules,$s))))

modes_scene := $(if $(SCENE),$(own_scene),$(system_scene))
# A fragment is empty until make has remade it, then make starts again.
$(if $(filter modes,$(goals)),$(if $(SCENE_$(modes_scene)_GEARS),\
  $(error SCENE=$(SCENE): it is a pair; modes are of systems$(,) scenes of several meshes$(,) carriers or drives)))
$(if $(SCENE_$(own_scene)_SYSTEM),$(foreach g,$(filter $(pair_goals) figures teeth $(figures) table1 animation,$(goals)),\
  $(error $g: SCENE=$(SCENE) is a system of several meshes$(,) carriers or drives; for it there is: make SCENE=$(SCENE) modes)))

.PHONY: modes
modes: out/$(modes_scene)/modes.h5 $(foreach e,tsv svg png,out/$(modes_scene)/report/modes.$e) ## natural frequencies and mode shapes of a system of rigid gears, SCENE (default: a planetary train), out/<scene>/report/modes.png

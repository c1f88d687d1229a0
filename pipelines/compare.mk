# Designs side by side: scenes, at the torques that they have in common, as one page and figures on common axes.
#
#   make compare SCENES='short.toml long.toml'       out/compare/short+long/index.html; TORQUE=150: of the figures (else the first in common)
#   make compare SCENES='train.toml other.toml'      trains, and pairs beside them: each at its own torque, of a pair the first
#   make compare STUDY=tolerances                    the two variants that the study marks by compare = [0, 3]
#
# The first design is what the others are compared with. Artifacts are those of the scenes, in out/<scene>/.

# While fragments are made, which are empty at first, nothing is known of their torques.
compared_known := $(if $(compared),$(if $(strip $(foreach s,$(compared),$(if $(SCENE_$s_TORQUES),,$s))),,yes))
# With a train among them: each at its own torque.
compared_trains := $(filter $(trains),$(compared))
compared_torques := $(if $(and $(compared_known),$(compared_trains)),own,$(strip $(foreach t,$(SCENE_$(firstword $(compared))_TORQUES),$(if $(filter-out $(foreach s,$(compared),$(if $(filter $t,$(SCENE_$s_TORQUES)),$s)),$(compared)),,$t))))
$(if $(compared_known),$(if $(compared_torques),,\
  $(error SCENES: the scenes have no torque in common: $(foreach s,$(compared),$s at $(SCENE_$s_TORQUES) N m;) give one of the torques to each)))
$(if $(and $(compared_trains),$(filter command,$(firstword $(origin TORQUE)))),$(error TORQUE=$(TORQUE): with a train among them ($(compared_trains)) each design is compared at its own torque; leave it out))
compared_torque := $(if $(compared_known),$(if $(filter command,$(firstword $(origin TORQUE))),$(or $(filter $(TORQUE),$(compared_torques)),\
  $(error TORQUE=$(TORQUE): the scenes have in common $(compared_torques) N m)),$(firstword $(compared_torques))))
# `+` joins their names, in which it is forbidden: `--` could stand in one.
compare_words := $(subst $() $(),+,$(strip $(compared)))
compare_folder := out/compare/$(compare_words)
# $(call at_compared,scene,torques)
at_compared = $(if $(filter own,$2),$(firstword $(SCENE_$1_TORQUES)),$2)
inputs_compare-rest = $(foreach s,$1,out/$s/T$(call at_compared,$s,$2)/static.h5)
inputs_compare-motion = $(foreach s,$1,$(call both_ways,$s,$(call at_compared,$s,$2),response))
compare_moves := $(if $(filter no,$(foreach s,$(compared),$(SCENE_$s_MOVES))),,yes)
compare_artifacts := $(foreach s,$(compared),$(foreach t,$(call at_compared,$s,$(compared_torques)),out/$s/T$t/static.h5) \
  $(if $(filter $s,$(pairs)),$(call impacts,$s,$(call at_compared,$s,$(compared_torques)))) \
  $(if $(compare_moves),$(call both_ways,$s,$(call at_compared,$s,$(compared_torques)),response)))
compare_pictures := $(patsubst %,$(compare_folder)/%-$(patsubst Town,own,T$(compared_torque)).png,compare-rest $(if $(compare_moves),compare-motion))

ifneq ($(compared_torque),)
# Another torque shows other pictures on the page.
plan_$(compare_words) = $(compare_pictures)
plans += $(B)/plans/compare/$(compare_words)
$(call together,$(compare_folder)/index.html $(compare_folder)/compare.tsv) &: $(compare_artifacts) $(compare_pictures) $(B)/plans/compare/$(compare_words) \
    $(call titles,$(compare_artifacts)) $(compared:%=$(B)/scenes/%.mk) $(call id,gear-compare) | $(B)/bin/gear-compare $(with_deps)
	$(B)/bin/gear-compare --output $(compare_folder)/index.html $(compare_artifacts) $(compare_pictures)
endif

.PHONY: compare
compare: $(if $(compared),$(compare_folder)/index.html) ## designs side by side on common axes, their differences first: SCENES='a.toml b.toml ...' (the first is compared with), or STUDY=, the two variants that it marks; out/compare/a+b/index.html
	$(call stands,compare: open $< in a browser; compare.tsv beside it holds the differences)

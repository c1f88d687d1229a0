# Studies: a scene, keys that vary in it, and a table and a figure of their response quantities.
#
#   make study STUDY=damping-torque-relief     data/studies/<name>.toml, or a path to a study of yours
#   make study-bodies STUDY=...                only the meshes and bodies that its variants share
#   make study STUDY=... SHARE=3/10            only the third tenth of the variants, no table: for several makes side by side
#
# gear-study checks study and scene and writes stage parameters for each variant, out/studies/<study>/variants/ab/ab12....toml, named after
# its content: a variant that stays is not made again, whatever else the study says. Beside it gear-variant writes the
# variant's artifact, .h5; the bodies are those of out/bodies, shared with all scenes and studies. Like fragments of scenes, the
# fragment of a study is remade in every run: STUDY_S_PAIRS (driver_driven, hashes of bodies), STUDY_S_<pair> (variants),
# STUDY_S_GEARS (names of driver and driven gear), STUDY_S_OPTIONS, BODIES.

study_stem := $(basename $(notdir $(STUDY)))
study_goals := $(filter study study-bodies,$(goals))
# Like scenes: a study of one's own does not take the place of one of the project.
own_study := $(if $(filter %.toml,$(STUDY)),$(STUDY))
ifneq ($(words $(STUDY)),0)
  $(if $(or $(own_study),$(findstring /,$(STUDY))),$(if $(filter %.toml,$(STUDY)),,$(error STUDY=$(STUDY): a study is a .toml file)))
  $(call plain_stem,STUDY,$(STUDY))
  study_of_name := $(if $(own_study),$(wildcard data/studies/$(study_stem).toml))
  $(if $(study_of_name),$(if $(shell cmp -s '$(STUDY)' $(study_of_name) || echo differs),\
    $(error STUDY=$(STUDY): out/studies/$(study_stem) is of $(study_of_name), which says otherwise; rename the file)))
endif
$(if $(study_goals),$(if $(STUDY),,$(error $(firstword $(study_goals)): which study? make $(firstword $(study_goals)) STUDY=<name>; \
  there are: $(patsubst data/studies/%.toml,%,$(wildcard data/studies/*.toml)), or a path to one of yours)))
study_file = $(if $(and $(own_study),$(filter $(study_stem),$1)),$(own_study),data/studies/$1.toml)

studies := $(sort $(if $(study_goals),$(study_stem)) $(foreach g,$(filter out/studies/%,$(goals)),$(word 3,$(subst /, ,$g))))
$(foreach s,$(studies),$(if $(wildcard $(call study_file,$s)),,$(error STUDY=$s: there is no $(call study_file,$s); \
  there are: $(patsubst data/studies/%.toml,%,$(wildcard data/studies/*.toml)); for a study elsewhere say STUDY=path/to/<name>.toml)))

study_fragments := $(studies:%=$(B)/studies/%.mk)
$(foreach f,$(filter-out $(wildcard $(study_fragments)),$(study_fragments)),$(shell mkdir -p $(dir $f) && touch $f))
$(study_fragments): $(B)/studies/%.mk: $(B)/bin/gear-study FORCE
	@new=$(call new,$@); said=$$($< --study '$(call study_file,$*)' --output $$new --out out --ids $(B)/id 2>&1) || { status=$$?; echo "$$said" >&2; exit $$status; }; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; echo "$$said" >&2; fi
include $(study_fragments)

study_variants = $(foreach p,$(STUDY_$1_PAIRS),$(STUDY_$1_$p:%=out/studies/$1/%.h5))
study_bodies = $(sort $(foreach p,$(STUDY_$1_PAIRS),$(foreach h,$(subst _, ,$p),out/bodies/$h/body.h5)))

define study_pair_rules # study, pair, driver, driven
$(STUDY_$1_$2:%=out/studies/$1/%.h5): %.h5: %.toml $(sort out/bodies/$3/body.h5 out/bodies/$4/body.h5) $(call id,gear-variant) | $(B)/bin/gear-variant
	$$(call run,variant) --params $$< --body $(word 1,$(STUDY_$1_GEARS))=out/bodies/$3/body.h5 --body $(word 2,$(STUDY_$1_GEARS))=out/bodies/$4/body.h5 --plan out/studies/$1/plan.toml $(STUDY_$1_OPTIONS) \
	  --output $$@ $$(call landed,variant)
endef

define study_rules # study
$(foreach p,$(STUDY_$1_PAIRS),$(eval $(call study_pair_rules,$1,$p,$(word 1,$(subst _, ,$p)),$(word 2,$(subst _, ,$p)))))
out/studies/$1/study.h5: out/studies/$1/plan.toml $(study_variants) $(call id,gear-study) | $(B)/bin/gear-study
	$(B)/bin/gear-study --gather $$< --output $$@

$(call together,out/studies/$1/study.tsv out/studies/$1/study.svg out/studies/$1/study.png) &: out/studies/$1/study.h5 $(call template,study) pipelines/plots/common.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot study --output out/studies/$1/study $$<
endef
$(foreach s,$(studies),$(eval $(call study_rules,$s)))

# The variants of a share, i of n equal ones.
SHARE ?=
share_of = $(shell bash -c 'IFS=/ read -r i n <<< "$(SHARE)"; [[ "$$i/$$n" =~ ^[1-9][0-9]{0,8}/[1-9][0-9]{0,8}$$ ]] && ((i <= n)) && \
  echo $$(((i - 1) * $(words $1) / n + 1)) $$((i * $(words $1) / n))')
shared = $(if $(share_of),,$(error SHARE=$(SHARE): it is i/n, the i-th of n shares, such as 3/10, with 999999999 shares at most))$(wordlist $(word 1,$(share_of)),$(word 2,$(share_of)),$1)

study_made := $(if $(filter study,$(goals)),$(if $(SHARE),$(call shared,$(call study_variants,$(study_stem))),\
  $(foreach e,tsv svg png,out/studies/$(study_stem)/study.$e)))

.PHONY: study study-bodies
study-bodies: $(if $(filter study-bodies,$(goals)),$(call study_bodies,$(study_stem))) ## meshes and bodies that the variants of STUDY share
study: $(study_made) ## variants of a scene, a table and a figure of their response quantities: STUDY=name or path; SHARE=3/10
	$(call stands,study: $(if $(SHARE),share $(SHARE) of its variants is there,table and figure are $(basename $<).{tsv$(,)png$(,)svg}))

.PHONY: deps-slurm test-slurm
deps-slurm: wanted := munge slurmctld slurmd slurm-client
deps-slurm: | $(with_deps) ## install the packages that only `test-slurm` uses
	$(install_wanted)
test-slurm: build $(tools:%=$(B)/id/%) | $(with_deps) $(filter deps-slurm,$(goals)) ## a study on a Slurm cluster of one node, made on the loopback device: the same bytes as here
	@B=$(B) SLURM=run MAKEFLAGS= MAKELEVEL= bash tests/slurm.sh | tee $(B)/slurm.log; ! grep -q -E '^(FAILED|skipped)' $(B)/slurm.log

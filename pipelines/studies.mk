# Studies: a scene, keys that vary in it, and a table and a figure of their response quantities.
#
#   make study STUDY=damping-torque-relief     data/studies/<name>.toml, or a path to a study of yours
#   make study-bodies STUDY=...                only the meshes and bodies that its variants share
#   make study STUDY=... SHARE=3/10            only the third tenth of the variants, no table: for several makes side by side
#
# gear-study writes stage parameters for each variant, out/studies/<study>/variants/ab/ab12....toml, named after its content: a variant that
# stays is not made again, whatever else the study says. Beside it gear-variant writes the variant's artifact, .h5; the bodies are those of
# out/bodies. The fragment of a study is remade in every run, like those of scenes: common/io/study_expansion.h says what stands in it.

study_stem := $(basename $(notdir $(STUDY)))
study_goals := $(filter study study-bodies,$(goals))
study_file = $(if $(and $(filter %.toml,$(STUDY)),$(filter $(study_stem),$1)),$(STUDY),data/studies/$1.toml)
studies := $(sort $(if $(study_goals),$(study_stem)) $(foreach g,$(filter out/studies/%,$(goals)),$(word 3,$(subst /, ,$g))))

study_fragments := $(studies:%=$(B)/studies/%.mk)
$(call empty_fragments,$(study_fragments))
$(study_fragments): $(B)/studies/%.mk: $(B)/bin/gear-study FORCE
	$(call fragment,$< --study '$(call study_file,$*)')
include $(study_fragments)

study_variants = $(foreach p,$(STUDY_$1_PAIRS),$(STUDY_$1_$p:%=out/studies/$1/%.h5))
study_bodies = $(sort $(foreach p,$(STUDY_$1_PAIRS),$(foreach h,$(subst _, ,$p),out/bodies/$h/body.h5)))

# $(call of_variant,study,hashes of the bodies of its gears): the recipe of the rules in the fragment
of_variant = $(call run,variant) --params $< $(subst :, ,$(join $(patsubst %,--body:%=out/bodies/,$(STUDY_$1_GEARS)),$(patsubst %,%/body.h5,$2))) \
  --plan out/studies/$1/plan.toml $(STUDY_$1_OPTIONS) --output $@ $(call landed,variant)
$(studies:%=out/studies/%/study.h5): out/studies/%/study.h5: out/studies/%/plan.toml $$(call study_variants,$$*) $(call id,gear-study) | $(B)/bin/gear-study
	$(B)/bin/gear-study --gather $< --output $@
study_files := $(addprefix out/studies/%/study,.tsv .svg .png)
.PRECIOUS: $(study_files)
$(study_files): out/studies/%/study.h5 $(call template,study) pipelines/plots/common.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot study --output out/studies/$*/study $<

# The variants of a share, i of n equal ones.
SHARE ?=
share_of = $(shell IFS=/ read -r i n <<< $(SHARE); echo $$(((i - 1) * $(words $1) / n + 1)) $$((i * $(words $1) / n)))
shared = $(wordlist $(word 1,$(share_of)),$(word 2,$(share_of)),$1)
study_made := $(if $(filter study,$(goals)),$(if $(SHARE),$(call shared,$(call study_variants,$(study_stem))),\
  $(foreach e,tsv svg png,out/studies/$(study_stem)/study.$e)))

.PHONY: study study-bodies
study-bodies: $(if $(filter study-bodies,$(goals)),$(call study_bodies,$(study_stem))) ## meshes and bodies that the variants of STUDY share
study: $(study_made) ## variants of a scene, a table and a figure of their response quantities: STUDY=name or path; SHARE=3/10
	$(call stands,study: $(if $(SHARE),share $(SHARE) of its variants is there,table and figure are $(basename $<).{tsv$(,)png$(,)svg}))

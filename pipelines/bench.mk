# Speed beside other people's programs, which nothing else needs.
#
#   make deps-bench bench     tables on standard output; without Siconos or CalculiX their columns are left out
#   make work-precision       out/figures/work-precision.{tsv,svg,png}, with SCENE in its report/; it holds times, so no two runs give the same bytes

.PHONY: bench
bench: $(B)/bin/whine-bench $(call bodies_of,$(standard_scene)) ## speed and memory, beside Siconos and CalculiX if `deps-bench` has installed them
	@$< --params out/$(standard_scene)/params/static.toml --sweep-params out/$(standard_scene)/params/sweep.toml --torque 150 \
	  --body pinion=out/$(standard_scene)/pinion/body.h5 --body wheel=out/$(standard_scene)/wheel/body.h5

# Of SCENE, or of a pair with a deep root and of 16 and 24 teeth of module 4.5 mm.
stress_benches := $(if $(filter bench-stress,$(goals)),$(patsubst %,bench-stress-of-%,$(if $(SCENE),$(own_scene),$(deep_scene) fzg-c)))
.PHONY: bench-stress $(stress_benches)
$(stress_benches): bench-stress-of-%: $(B)/bin/whine-bench-stress out/%/params/static.toml out/%/params/sweep.toml $$(call bodies_of,$$*)
	@$< --params out/$*/params/static.toml --sweep-params out/$*/params/sweep.toml $(call named,--body,$*,body) --torque 150
bench-stress: $(stress_benches) ## root stress of two pairs at one position beside CalculiX, which `deps-bench` installs (SCENE: of its pair)

.PHONY: bench-width
bench-width: $(B)/bin/whine-bench-width ## beside CalculiX, which `deps-bench` installs: bodies over the face width and their root stress, spur and helical, and the load over the face of a misaligned pair
	@$< data/scenes/parker2000-misaligned.toml

.PHONY: bench-levels
bench-levels: $(B)/bin/whine-bench-levels ## levels of [fidelity] width side by side, of five scenes: stiffness, transmission error, K_Hbeta, CPU time; what the width costs a body
	@$< $(patsubst %,data/scenes/%.toml,parker2000-standard-tooth parker2000-misaligned parker2000-helical-0_5 parker2000-helical-1_0 helical-17-67)

# One static position of an internal pair beside CalculiX: three mesh phases, of which the middle one has two pairs of teeth in contact.
.PHONY: bench-internal
bench-internal: $(B)/bin/whine-bench $(call bodies_of,$(internal_scene)) ## static positions of a planet in a ring beside CalculiX, if `deps-bench` has installed it
	@$< --params out/$(internal_scene)/params/static.toml $(call named,--body,$(internal_scene),body) --torque 200 --position 0 --position 0.25 --position 0.5

# A train's steps beside those of the pair with a standard tooth; SCENE: of its train.
bench_train := $(if $(SCENE),$(own_scene),$(train_scene))
.PHONY: bench-train
bench-train: $(B)/bin/whine-bench-train $(call bodies_of,$(standard_scene)) $(call bodies_of,$(bench_train)) ## time of a step of a train beside that of a pair and of the pair told as a train
	@$< --params out/$(standard_scene)/params/static.toml --sweep-params out/$(standard_scene)/params/sweep.toml $(call named,--body,$(standard_scene),body) \
	  --train-params out/$(bench_train)/params/sweep.toml $(call named,--train-body,$(bench_train),body)

# Of SCENE, or of the first pair.
.PHONY: work-precision
work-precision: $(B)/bin/whine-work-precision | $(with_deps) ## error against CPU time of the settings of a scene, with those that an accepted error chooses (minutes)
	@$< --scene $(or $(SCENE),data/scenes/first-pair.toml) --output $(figure_folder)/work-precision

# Pairs, trains and helical pairs that ship, and made-up ones.
accuracy_scenes := first-pair fzg-c nasa28 internal-pair parker2000-standard-tooth parker2000-calibrated parker2000-deep-root parker2000-grade5 three-in-line oh58-planetary parker2000-helical-0_5 helical-17-67
.PHONY: verify-accuracy
verify-accuracy: $(B)/bin/whine-verify-accuracy | $(with_deps) ## errors accepted in [accuracy] beside true ones, of 40 scenes (hours)
	@$< 2,1,0.5,0.2 $(accuracy_scenes:%=data/scenes/%.toml) random:0-19 random-helical:0-7

# Speed beside other people's programs, which nothing else needs.
#
#   make deps-bench bench     tables on standard output; without Siconos or CalculiX their columns are left out
#   make work-precision       out/figures/work-precision.{tsv,svg,png}; it holds times, so no two runs give the same bytes

bench_packages := libsiconos-numerics-dev calculix-ccx

.PHONY: deps-bench
deps-bench: wanted := $(bench_packages)
deps-bench: | $(with_deps) ## install the packages that only `bench` and the tests beside Siconos use
	$(install_wanted)

.PHONY: bench
bench: $(B)/bin/whine-bench $(call pair_bodies,$(standard_scene)) ## speed and memory, beside Siconos and CalculiX if `deps-bench` has installed them
	@$< --params out/$(standard_scene)/params/static.toml --sweep-params out/$(standard_scene)/params/sweep.toml --torque 150 \
	  --body pinion=out/$(standard_scene)/pinion/body.h5 --body wheel=out/$(standard_scene)/wheel/body.h5

# Of SCENE, or of a pair with a deep root and of 16 and 24 teeth of module 4.5 mm.
stress_scenes := $(if $(SCENE),$(own_scene),$(deep_scene) fzg-c)
define stress_rule # scene
.PHONY: bench-stress-of-$1
bench-stress: bench-stress-of-$1
bench-stress-of-$1: $(B)/bin/whine-bench-stress out/$1/params/static.toml out/$1/params/sweep.toml $(pair_bodies)
	@$$< --params out/$1/params/static.toml --sweep-params out/$1/params/sweep.toml $(pair_options) --torque 150
endef
.PHONY: bench-stress
bench-stress: ## root stress of two pairs at one position beside CalculiX, which `deps-bench` installs (SCENE: of its pair)
$(if $(filter bench-stress,$(goals)),$(foreach s,$(stress_scenes),$(eval $(call stress_rule,$s))))

# One static position of an internal pair beside CalculiX: three mesh phases, of which the middle one has two pairs of teeth in contact.
.PHONY: bench-internal
bench-internal: $(B)/bin/whine-bench $(call pair_bodies,$(internal_scene)) ## static positions of a planet in a ring beside CalculiX, if `deps-bench` has installed it
	@$< --params out/$(internal_scene)/params/static.toml $(call pair_options,$(internal_scene)) --torque 200 --position 0 --position 0.25 --position 0.5

.PHONY: work-precision
work-precision: $(B)/bin/whine-work-precision $(call pair_bodies,$(deep_scene)) ## error against CPU time of each numerical choice, at a damping with two branches
	@$< --static-params out/$(deep_scene)/params/static.toml --sweep-params out/$(deep_scene)/params/sweep.toml \
	  $(call pair_options,$(deep_scene)) --torque 150 --rayleigh-stiffness 2.0e-6 --output out/figures/work-precision

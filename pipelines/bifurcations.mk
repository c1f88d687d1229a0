# The table of bifurcations of a pair, data/published/bifurcations.tsv: folds of the branches at the torques of P2000,
# each with its change with half the time step, twice the strips and twice the modes. 20 branches, 5 min of CPU.
bifurcation_torques := 100 150 200 300 600
bifurcation_branches := $(foreach s,$(own_scene) $(bifurcation_scenes),$(bifurcation_torques:%=out/$s/T%/branch.h5))

.PHONY: bifurcations
bifurcations: $(bifurcation_branches) $(B)/bin/gear-inspect ## renew data/published/bifurcations.tsv: folds at 100 to 600 N m, with what finer steps, strips and modes change
	@pipelines/folds.sh bifurcations $(B)/bin out $(own_scene) $(bifurcation_torques) > $(call new,$@) && mv $(call new,$@) data/published/bifurcations.tsv

# Each jump of the sweeps beside the fold of the same map, data/published/jumps.tsv. 8 sweeps and 4 branches, 80 s of CPU.
jump_torques := 100 150 200 300
jump_artifacts := $(foreach t,$(jump_torques),$(foreach f,branch up/jumps down/jumps,out/$(own_scene)/T$t/$f.h5))

.PHONY: jump-folds
jump-folds: $(jump_artifacts) $(B)/bin/gear-inspect ## renew data/published/jumps.tsv: every jump of the sweeps at 100 to 300 N m, located to 0.05 Hz, beside the fold
	@pipelines/folds.sh jumps $(B)/bin out $(own_scene) $(jump_torques) > $(call new,$@) && mv $(call new,$@) data/published/jumps.tsv

# The table of bifurcations of the paper's scene, data/published/bifurcations.tsv: folds of the branches at the torques of P2000,
# each with its change with half the time step, twice the strips and twice the modes. 20 branches, 5 min of CPU.
bifurcation_torques := 100 150 200 300 600
bifurcation_branches := $(foreach s,$(paper_scene) $(bifurcation_scenes),$(bifurcation_torques:%=out/$s/T%/branch.h5))

.PHONY: bifurcations
bifurcations: $(bifurcation_branches) $(B)/bin/gear-inspect ## renew data/published/bifurcations.tsv: folds at 100 to 600 N m, with what finer steps, strips and modes change
	@pipelines/bifurcations.sh $(B)/bin out $(paper_scene) $(bifurcation_torques) > $(call new,$@) && mv $(call new,$@) data/published/bifurcations.tsv

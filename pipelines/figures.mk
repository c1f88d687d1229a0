# Figures of the paper, always of its own scene: out/figures/figNN.{tsv,svg,png}.
#
# A new figure is a line of inputs, a gnuplot template pipelines/plots/figNN.gp and a target with its line of help.

paper_scene := parker2000
paper := out/$(paper_scene)

inputs_fig01 := $(paper)/pinion/mesh.h5 $(paper)/wheel/mesh.h5 $(paper)/T100/static.h5
inputs_fig05 := $(paper)/T150/up/response.h5 $(paper)/T150/down/response.h5
inputs_fig12 := $(foreach t,100 200 300,$(paper)/T$t/static.h5)
inputs_fig13 := $(inputs_fig12)
inputs_error-budget := $(paper)/T150/error_budget.h5

paper_figures := fig01 fig05 fig12 fig13
figures := $(paper_figures) error-budget
figure_inputs := $(sort $(foreach f,$(figures),$(inputs_$f)))

define figure_rules # figure
out/figures/$1.tsv out/figures/$1.svg out/figures/$1.png &: $(inputs_$1) pipelines/plots/$1.gp $(call id,gear-plot) \
    | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot $1 --output out/figures/$1 $(inputs_$1)

$1: out/figures/$1.tsv out/figures/$1.svg out/figures/$1.png
endef

$(foreach f,$(figures),$(eval $(call figure_rules,$f)))

.PHONY: figures $(figures)
figures: $(paper_figures) ## all figures of the paper that are there so far
fig01: ## the finite element mesh of the pair
fig05: ## RMS of the dynamic transmission error against mesh frequency, speed up and down, 150 N m
fig12: ## static transmission error over a mesh period and its spectrum
fig13: ## mesh stiffness over a mesh period and its spectrum
error-budget: ## what refining each discretisation of the static stage alone changes, and what other choices change, 150 N m

# Figures of the paper, always of its own scenes: out/figures/figNN.{tsv,svg,png}.
#
# A new figure is a line of inputs, a gnuplot template pipelines/plots/figNN.gp and a target with its line of help. Figures
# of one kind share a template: drawn_as_figNN names it. options_figNN: operating points, in words of gear-plot.

paper_scene := parker2000
calibrated_scene := parker2000-calibrated
paper_scenes := $(paper_scene) $(calibrated_scene)
paper := out/$(paper_scene)

# $(call both_ways,scenes,torques,artifact): sweeps up and down
both_ways = $(foreach s,$1,$(foreach t,$2,$(foreach d,up down,out/$s/T$t/$d/$3.h5)))

inputs_fig01 := $(paper)/pinion/mesh.h5 $(paper)/wheel/mesh.h5 $(paper)/T100/static.h5
inputs_fig03 := $(foreach a,mesh body,$(paper)/pinion/$a.h5 $(paper)/wheel/$a.h5) $(paper)/T150/static.h5
inputs_fig05 := $(call both_ways,$(paper_scenes),150,response)
inputs_fig07 := $(call both_ways,$(paper_scenes),100 200 300,response)
drawn_as_fig07 := fig05
inputs_fig07-600 := $(call both_ways,$(paper_scenes),300 600,response)
drawn_as_fig07-600 := fig05
# the branches: first the scene that has two of them at these speeds
inputs_fig08 := $(call both_ways,$(calibrated_scene) $(paper_scene),150,sweep)
options_fig08 := --mesh-frequency 2400
inputs_fig09 := $(inputs_fig08)
options_fig09 := --mesh-frequency 1300
drawn_as_fig09 := fig08
inputs_fig10 := $(inputs_fig08)
options_fig10 := --mesh-frequency 2400
inputs_fig11 := $(inputs_fig08)
options_fig11 := --mesh-frequency 1300
drawn_as_fig11 := fig10
inputs_fig12 := $(foreach t,100 200 300,$(paper)/T$t/static.h5)
inputs_fig13 := $(inputs_fig12)
inputs_fig14-elastic := $(inputs_fig07)
inputs_table1 := $(foreach t,100 200 300,$(paper)/T$t/impact.h5)
published_table1 := data/published/parker2000-table1.tsv
inputs_error-budget := $(paper)/T150/error_budget.h5

paper_figures := fig01 fig03 fig05 fig07 fig07-600 fig08 fig09 fig10 fig11 fig12 fig13 fig14-elastic
figures := $(paper_figures) error-budget
figure_inputs := $(sort $(foreach f,$(figures) table1,$(inputs_$f)))

drawn_as = $(or $(drawn_as_$1),$1)

define figure_rules # figure
out/figures/$1.tsv out/figures/$1.svg out/figures/$1.png &: $(inputs_$1) pipelines/plots/$(drawn_as).gp $(call id,gear-plot) \
    | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot $(drawn_as) --output out/figures/$1 $(options_$1) $(inputs_$1)

$1: out/figures/$1.tsv out/figures/$1.svg out/figures/$1.png
endef

$(foreach f,$(figures),$(eval $(call figure_rules,$f)))

out/figures/table1.tsv out/figures/table1.txt &: $(inputs_table1) $(published_table1) $(call id,gear-plot) \
    | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot table1 --published $(published_table1) --output out/figures/table1 $(inputs_table1)

.PHONY: figures $(figures) table1
figures: $(paper_figures) out/figures/table1.txt ## all figures and tables of the paper that are there so far
fig01: ## the finite element mesh of the pair
fig03: ## the contact zone: candidate pairs, inner and outer region, strips and their pressure, 150 N m
fig05: ## RMS of the dynamic transmission error against mesh frequency, speed up and down, 150 N m
fig07: ## the same at 100, 200 and 300 N m
fig07-600: ## the same at 300 and 600 N m
fig08: ## dynamic transmission error over time and its spectrum, both branches at 2400 Hz, 150 N m
fig09: ## the same at 1300 Hz
fig10: ## tooth loads over the mesh phase, both branches at 2400 Hz, 150 N m
fig11: ## the same at 1300 Hz
fig12: ## static transmission error over a mesh period and its spectrum
fig13: ## mesh stiffness over a mesh period and its spectrum
fig14-elastic: ## RMS and mean of the dynamic transmission error at 100, 200 and 300 N m
table1: out/figures/table1.txt ## natural frequencies by ring-down at 100, 200 and 300 N m beside those of the paper
	@cat $<
error-budget: ## what refining each discretisation of the static stage alone changes, and what other choices change, 150 N m

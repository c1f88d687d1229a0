# Figures: of the paper's scene in out/figures/, of SCENE in out/<scene>/report/; a report by its path is of any scene.
#
# A new figure is a line of inputs, one of the paper's torques, a gnuplot template pipelines/plots/figNN.gp and a target
# with its line of help.

paper_scene := parker2000

# inputs_<figure>: $1 scene, $2 torques. What is drawn at one torque takes the first, curves one each; six can be told apart.
inputs_fig01 = $(foreach g,$(SCENE_$1_DRIVER) $(SCENE_$1_DRIVEN),out/$1/$g/mesh.h5) out/$1/T$(firstword $2)/static.h5
inputs_fig05 = $(foreach d,up down,out/$1/T$(firstword $2)/$d/response.h5)
inputs_fig12 = $(foreach t,$(wordlist 1,6,$2),out/$1/T$t/static.h5)
inputs_fig13 = $(inputs_fig12)
inputs_fig14 = $(foreach t,$(wordlist 1,6,$2),$(foreach d,up down,out/$1/T$t/rectangular/$d/response.h5))
inputs_fig15 = $(foreach m,rectangular-fig15 rectangular,out/$1/T$(firstword $2)/$m/down/sweep.h5)
inputs_fig16 = $(foreach t,$(wordlist 1,6,$2),$(foreach d,up down,out/$1/T$t/secant/$d/response.h5))
inputs_error-budget = out/$1/T$(firstword $2)/error_budget.h5

paper_torques_fig01 := 100
paper_torques_fig05 := 150
paper_torques_fig12 := 100 200 300
paper_torques_fig13 := 100 200 300
paper_torques_fig14 := 100 200 300
paper_torques_fig15 := 150
paper_torques_fig16 := 100 200 300
paper_torques_error-budget := 150

paper_figures := fig01 fig05 fig12 fig13 fig14 fig15 fig16
figures := $(paper_figures) error-budget
inputs_of_paper = $(call inputs_$1,$(paper_scene),$(paper_torques_$1))
figure_inputs = $(foreach f,$(figures),$(call inputs_of_paper,$f))

define figure_rule # figure, path without extension, inputs, what else it depends on
$2.tsv $2.svg $2.png &: $3 $4 pipelines/plots/$1.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot $1 --output $2 $3
endef

# The fragment of a scene says its torques: a report depends on the list, too, not only on what stands at each.
define figure_rules # scene; needs its fragment
$(foreach f,$(figures),\
  $(if $(filter $(paper_scene),$1),$(eval $(call figure_rule,$f,out/figures/$f,$(call inputs_of_paper,$f)))) \
  $(eval $(call figure_rule,$f,out/$1/report/$f,$(call inputs_$f,$1,$(SCENE_$1_TORQUES)),$(B)/scenes/$1.mk)))
endef

# fig14 is drawn as fig16 is.
$(addprefix out/figures/fig14.,tsv svg png): pipelines/plots/fig16.gp

.PHONY: figures $(figures)
$(figures): %: $$(foreach e,tsv svg png,$$(if $$(SCENE),out/$$(own_scene)/report,out/figures)/%.$$e)
figures: $(paper_figures) ## all figures of the paper that are there so far, or all of SCENE
fig01: ## the finite element mesh of the pair
fig05: ## RMS of the dynamic transmission error against mesh frequency, speed up and down, 150 N m (SCENE: its first torque)
fig12: ## static transmission error over a mesh period and its spectrum
fig13: ## mesh stiffness over a mesh period and its spectrum
fig14: ## lumped model, rectangular stiffness: RMS and mean of the transmission error against mesh frequency
fig15: ## lumped model, rectangular stiffness: net mesh force on the upper and the lower branch, 150 N m
fig16: ## lumped model, stiffness of the statics at each torque: RMS and mean of the transmission error
error-budget: ## what refining each discretisation of the static stage alone changes, and what other choices change, 150 N m (SCENE: its first torque)

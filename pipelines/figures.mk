# Figures and tables: the paper's in out/figures/, those of SCENE in out/<scene>/report/; a report by its path is of any scene.
# The page of a report, index.html, is made of them and of artifacts, by gear-report.
#
# A new figure is a line of inputs, the paper's torques, a name in the list of figures and a target with its line of help; a gnuplot
# template pipelines/plots/figNN.gp where it is no figure of panels. Figures of one kind share a drawing: drawn_as_figNN names it.
# options_figNN: operating points, in words of gear-plot.

# The reading of P2000 that agrees best; its pair with a standard tooth, as printed and with less damping.
paper_scene := parker2000
standard_scene := parker2000-standard-tooth
calibrated_scene := parker2000-calibrated
paper_scenes := $(paper_scene) $(standard_scene) $(calibrated_scene)
# A deeper root, sharper: what `bench-stress` and `work-precision` measure.
deep_scene := parker2000-deep-root
# What figures of motions show below the paper's scene: BESIDE='parker2000-standard-tooth parker2000-calibrated'.
BESIDE ?=
$(if $(filter-out $(paper_scenes),$(BESIDE)),$(error BESIDE=$(BESIDE): it is one or more of $(paper_scenes)))
shown_scenes := $(paper_scene) $(filter-out $(paper_scene),$(BESIDE))
graded_scene := parker2000-grade5
# The standard tooth with tip relief, at both dampings.
relief_scenes := $(foreach s,$(standard_scene) $(calibrated_scene),$(foreach r,20_9 22_2 23_6,$s-relief-$r))
cracked_scene := parker2000-crack
bearing_scene := parker2000-bearings
internal_scene := internal-pair
friction_scene := fzg-c-friction
# of rigid bodies; see systems.mk
system_scene := lin-parker-planetary
# of elastic ones
elastic_system_scene := oh58-planetary

# $(call both_ways,scenes,torques,artifact): sweeps up and down
both_ways = $(foreach s,$1,$(foreach t,$2,$(foreach d,up down,out/$s/T$t/$d/$3.h5)))
# $(call of_gears,scene,artifact): of driver and driven gear
of_gears = $(foreach g,$(SCENE_$1_DRIVER) $(SCENE_$1_DRIVEN),out/$1/$g/$2.h5)
# $(call impacts,scenes,torques): for damping ratios, where there are ring-downs
impacts = $(foreach s,$1,$(if $(filter no,$(SCENE_$s_RINGS_DOWN)),,$(foreach t,$2,out/$s/T$t/impact.h5)))
# $(call titles,inputs): what figures call the scenes of their inputs
titles = $(sort $(foreach f,$1,out/$(word 2,$(subst /, ,$f))/params/title.txt))
# $(call each,torques): those that get a curve each; six can be told apart
each = $(wordlist 1,6,$1)

# inputs_<figure>: $1 scenes, $2 torques. What is drawn at one torque takes the first.
inputs_fig01 = $(call of_gears,$1,mesh) out/$1/T$(firstword $2)/static.h5
inputs_fig03 = $(call of_gears,$1,mesh) $(call of_gears,$1,body) out/$1/T$(firstword $2)/static.h5
inputs_fig05 = $(call both_ways,$1,$(firstword $2),response) $(call impacts,$1,$(firstword $2))
inputs_fig07 = $(call both_ways,$1,$(call each,$2),response) $(call impacts,$1,$(call each,$2))
inputs_fig07-600 = $(inputs_fig07)
# The same with the orbits that no sweep finds.
inputs_fig05-branches = $(inputs_fig05) $(foreach s,$1,out/$s/T$(firstword $2)/branch.h5)
inputs_fig07-branches = $(inputs_fig07) $(foreach s,$1,$(foreach t,$(call each,$2),out/$s/T$t/branch.h5))
inputs_multipliers = out/$1/T$(firstword $2)/branch.h5
inputs_fig08 = $(call both_ways,$1,$(firstword $2),sweep) $(call impacts,$1,$(firstword $2))
inputs_fig09 = $(inputs_fig08)
inputs_fig10 = $(inputs_fig08)
inputs_fig11 = $(inputs_fig08)
inputs_fig12 = $(foreach t,$(call each,$2),out/$1/T$t/static.h5)
inputs_fig13 = $(inputs_fig12)
inputs_load-sharing = $(inputs_fig12)
inputs_waterfall = $(call both_ways,$1,$(firstword $2),sweep)
inputs_order-cuts = $(call both_ways,$1,$(firstword $2),response)
inputs_tooth-loads = $(inputs_fig08)
inputs_bearing-forces = $(call both_ways,$1,$(firstword $2),response) $(call impacts,$1,$(firstword $2))
inputs_fig14 = $(foreach t,$(call each,$2),$(call both_ways,$1,$t/rectangular,sweep))
inputs_fig14-elastic = $(inputs_fig07)
inputs_fig15 = $(foreach m,rectangular-fig15 rectangular,out/$1/T$(firstword $2)/$m/down/sweep.h5)
inputs_fig16 = $(foreach t,$(call each,$2),$(call both_ways,$1,$t/secant,sweep))
inputs_profile-chart = out/$1/T$(firstword $2)/static.h5
inputs_relief-jumps = $(inputs_fig05)
inputs_error-budget = out/$1/T$(firstword $2)/error_budget.h5
inputs_sidebands = out/$1/T$(firstword $2)/static.h5 out/$1/T$(firstword $2)/up/response.h5
inputs_root-stress = out/$1/T$(firstword $2)/static.h5 $(call both_ways,$1,$(firstword $2),response)
inputs_root-stress-branches = $(inputs_root-stress) out/$1/T$(firstword $2)/branch.h5
inputs_flank-pressure = $(inputs_root-stress)
inputs_efficiency = $(foreach t,$(call each,$2),out/$1/T$t/static.h5 $(call both_ways,$1,$t,response))
inputs_crack = out/$1/T$(firstword $2)/static.h5
inputs_table1 = $(foreach t,$2,out/$1/T$t/impact.h5)

drawn_as = $(or $(drawn_as_$1),$1)
# Figures of panels have no template of their own.
template = $(or $(wildcard pipelines/plots/$1.gp),pipelines/plots/panels.gp)
drawn_as_fig07 := fig05
drawn_as_fig07-600 := fig05
drawn_as_fig05-branches := fig05
drawn_as_fig07-branches := fig05
drawn_as_fig09 := fig08
drawn_as_fig11 := fig10
drawn_as_fig14 := fig16
drawn_as_fig14-elastic := fig16
drawn_as_profile-chart := profile
drawn_as_relief-jumps := fig05
drawn_as_root-stress-branches := root-stress
drawn_as_histories := fig08
drawn_as_history-loads := fig10
$(foreach d,up down,$(eval drawn_as_runup-$d := runup))

$(foreach f,fig08 fig10,$(eval options_$f := --mesh-frequency 2400))
$(foreach f,fig09 fig11,$(eval options_$f := --mesh-frequency 1300))
# Time histories at a speed of the user's choice, one of the sweep's: figures of their own for each speed.
$(foreach f,histories history-loads,$(eval options_$f = --mesh-frequency $$(AT)))
history_figures = $(foreach f,histories history-loads,$(figure_folder)/$f-$(AT)Hz-T$(TORQUE))
# upper and lower branch
options_fig15 := --mesh-frequency 2200,2150

$(foreach f,fig05 fig07 fig05-branches fig07-branches fig07-600 fig08 fig09 fig10 fig11 fig14-elastic,$(eval paper_scenes_$f := $(shown_scenes)))
paper_scenes_sidebands := $(graded_scene)
paper_scenes_crack := $(cracked_scene)
paper_scenes_bearing-forces := $(bearing_scene)
paper_scenes_efficiency := $(friction_scene)
paper_scenes_profile-chart := $(firstword $(relief_scenes))
paper_scenes_relief-jumps := $(standard_scene) $(calibrated_scene) $(relief_scenes)
$(foreach f,profile-chart relief-jumps waterfall order-cuts tooth-loads root-stress root-stress-branches flank-pressure bearing-forces fig03 fig05 fig05-branches multipliers fig08 fig09 fig10 fig11 fig15 error-budget sidebands crack,$(eval paper_torques_$f := 150))
$(foreach f,fig01 fig07 fig07-branches fig12 fig13 load-sharing fig14 fig14-elastic fig16 table1,$(eval paper_torques_$f := 100 200 300))
paper_torques_fig07-600 := 300 600
paper_torques_efficiency := 100 200 300

report_figures := fig01 fig03 fig05 fig07 fig12 fig13 fig14 fig14-elastic fig16
# at the paper's own speeds, torques or levels
paper_only := fig07-600 fig08 fig09 fig10 fig11 fig15
paper_figures := $(sort $(report_figures) $(paper_only))
# of any pair, none of the paper's
other_figures := fig05-branches fig07-branches multipliers load-sharing waterfall order-cuts tooth-loads root-stress root-stress-branches flank-pressure efficiency bearing-forces error-budget profile-chart sidebands crack
figures := $(paper_figures) $(other_figures) relief-jumps
inputs_of_paper = $(call inputs_$1,$(or $(paper_scenes_$1),$(paper_scene)),$(paper_torques_$1))

printed_claims := data/published/claims.toml
# What gear-scorecard --files lists, of both scenes of the paper.
scorecard_files := $(foreach t,100 150 200 300 600,T$t/static.h5 T$t/up/response.h5 T$t/down/response.h5) \
  $(foreach t,100 150 200 300,T$t/impact.h5 T$t/rectangular/up/response.h5 T$t/rectangular/down/response.h5) \
  $(foreach t,100 200 300,T$t/secant/up/response.h5 T$t/secant/down/response.h5) \
  T150/up/sweep.h5 T150/down/sweep.h5 T150/rectangular/up/sweep.h5
inputs_scorecard := $(foreach s,$(paper_scenes),$(scorecard_files:%=out/$s/%))

figure_inputs = $(if $(filter bifurcations,$(goals)),$(bifurcation_branches)) $(foreach f,$(figures) table1,$(call inputs_of_paper,$f)) $(inputs_scorecard)

$(if $(SCENE),$(foreach f,$(filter $(paper_only) relief-jumps,$(goals)),\
  $(error $f shows the paper at speeds, torques, levels or reliefs of its own; for SCENE there are $(report_figures) $(other_figures) table1)))

$(call together,$(addprefix out/figures/scorecard.,tsv txt)) &: $(inputs_scorecard) $(printed_claims) data/published/fitted.toml $(call id,gear-scorecard) | $(B)/bin/gear-scorecard $(with_deps)
	$(B)/bin/gear-scorecard --printed $(printed_claims) --fitted data/published/fitted.toml --output out/figures/scorecard $(inputs_scorecard)

# AXIS=rpm:pinion: the speed of a gear, of a train also of its carrier, in place of the mesh frequency; DB=1e-6: RMS of the DTE and of its orders in dB re this length in m.
AXIS ?=
DB ?=
$(if $(AXIS),$(if $(filter rpm:%,$(AXIS)),$(if $(filter 1,$(words $(AXIS))),,$(error AXIS=$(AXIS): it is one word)),\
  $(error AXIS=$(AXIS): it is rpm:<gear>$(,) such as rpm:pinion or rpm:driver$(,) of a train rpm:<gear or carrier>)))
$(if $(DB),$(if $(shell awk -v x='$(DB)' 'BEGIN { if (x ~ /^[0-9.]+([eE][-+]?[0-9]+)?$$/ && x + 0 > 0) print "yes" }'),,\
  $(error DB=$(DB): it is the length in m that is 0 dB$(,) such as 1e-6)))
speed_figures := fig05 fig07 fig05-branches fig07-branches fig07-600 fig14 fig14-elastic fig16 relief-jumps waterfall order-cuts tooth-loads bearing-forces efficiency root-stress root-stress-branches flank-pressure compare-motion runup-up runup-down campbell system-sweep system-branch
level_figures := order-cuts compare-motion runup-up runup-down system-sweep system-branch
# A figure that would not take them is not drawn without them; `modes` draws the Campbell diagram, too.
not_drawn_with = $(filter-out $1,$(filter $(figures) table1 histories multipliers fold-curves jump-map sensitivity harris-map branches modes \
  system-static system-ringdown system-sweep system-branch animation study reading work-precision,$(goals)))
$(if $(AXIS),$(if $(call not_drawn_with,modes $(speed_figures)),$(error AXIS=$(AXIS): $(firstword $(call not_drawn_with,modes $(speed_figures))) \
  is not drawn against the speed of a gear; leave AXIS out. It is for $(filter-out compare-motion runup-up runup-down campbell,$(speed_figures))$(,) modes$(,) runup$(,) compare and report)))
$(if $(DB),$(if $(call not_drawn_with,$(level_figures)),$(error DB=$(DB): $(firstword $(call not_drawn_with,$(level_figures))) \
  is not drawn in dB; leave DB out. It is for order-cuts$(,) system-sweep$(,) system-branch$(,) runup$(,) compare and report)))
axis_options = $(strip $(if $(AXIS),$(if $(filter $1,$(speed_figures)),--axis '$(AXIS)')) $(if $(DB),$(if $(filter $1,$(level_figures)),--db $(DB))))
# Only figures that have the choice remember it.
axis_plan_file = $(if $(filter $1,$(speed_figures)),$(B)/plans/axes/$2)
axis_plan = $(if $(axis_plan_file),$(call plan_rule,$(axis_plan_file),figure $(subst ',,$(axis_options))))

define figure_rule # figure, path without extension, inputs, what else it depends on
$(axis_plan)
$(call together,$2.tsv $2.svg $2.png) &: $3 $4 $(axis_plan_file) $(call titles,$3) $(call template,$(drawn_as)) pipelines/plots/common.gp $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot $(drawn_as) --output $2 $(options_$1) $(axis_options) $(if $(filter out/figures/fig%,$2),--paper-figure $1) $3
endef

# Heard at a speed of the user's choice, the rising branch first, or of a run-up, then of the run-down over the same speeds; with a
# transfer function a file of its own.
sound_file = $(figure_folder)/sound-$(if $(sound_of_runup),runup-$(subst _,-,$(runup_stem)),$(AT)Hz)-T$(TORQUE)$(if $(TRANSFER),-$(basename $(notdir $(TRANSFER))))
# Path and content: a transfer function of the same name in another folder may be older than the sound of the first.
sound_plan_file = $(if $(TRANSFER),$(B)/plans/$(own_scene)/$(notdir $(sound_file)))
sound_plan = --transfer $(TRANSFER) $(firstword $(shell sha256sum 2>/dev/null < '$(TRANSFER)'))
sound_inputs = $(if $(sound_of_runup),out/$1/T$(TORQUE)/up/runup_$(runup_stem).h5 out/$1/T$(TORQUE)/down/runup_$(RATE)$(if $(FROM),_$(TO)_$(FROM)).h5,$(call both_ways,$1,$(TORQUE),sweep))
define sound_rule # run-ups or sweeps
$(call together,$(sound_file).wav $(sound_file).tsv) &: $1 $(TRANSFER) $(sound_plan_file) $(call id,gear-sound) | $(B)/bin/gear-sound $(with_deps)
	$(B)/bin/gear-sound $(if $(sound_of_runup),$(foreach f,$1,--runup $f),$(foreach f,$1,--sweep $f) --mesh-frequency $(AT)) $(if $(TRANSFER),--transfer '$(TRANSFER)') --output $(sound_file)
endef

$(if $(filter sound,$(goals)),$(if $(TRANSFER),$(if $(wildcard $(TRANSFER)),,$(error TRANSFER=$(TRANSFER): there is no such file))))
# Results beside the REXS model that the scene was imported from. Path, stage and content, as for a sound.
$(if $(filter export,$(goals)),$(if $(MODEL),$(if $(wildcard $(MODEL)),,$(error MODEL=$(MODEL): there is no such file)),\
  $(error export: which model? make export SCENE=my-pair.toml MODEL=stage.rexs, the REXS model that the scene was imported from)))
export_file = $(figure_folder)/$(basename $(notdir $(MODEL)))-results$(suffix $(MODEL))
export_plan_file = $(B)/plans/$(own_scene)/$(notdir $(export_file)).export
export_plan = --model $(MODEL) --stage $(STAGE) $(firstword $(shell sha256sum 2>/dev/null < '$(MODEL)'))
export_inputs = $(foreach t,$2,out/$1/T$t/static.h5) $(call impacts,$1,$2) $(if $(call teeth,$1,cracked),,$(call both_ways,$1,$2,response))
define export_rule # artifacts
$(export_file): $1 $(MODEL) $(export_plan_file) $(call titles,$1) $(call id,gear-export) | $(B)/bin/gear-export $(with_deps)
	$(B)/bin/gear-export --model '$(MODEL)' $(if $(STAGE),--stage '$(STAGE)') --output $(export_file) $1
endef

# A run-up with the sweeps beside it.
runup_figure = $(figure_folder)/runup-$(subst _,-,$(runup_stem))-$(WAY)-T$(TORQUE)
inputs_runup = out/$1/T$(TORQUE)/$(WAY)/runup_$(runup_stem).h5 $(call both_ways,$1,$(TORQUE),response)

define table_rule # path without extension, inputs, published values, what else it depends on
$(call together,$1.tsv $1.txt) &: $2 $3 $4 $(call id,gear-plot) | $(B)/bin/gear-plot $(with_deps)
	$(B)/bin/gear-plot table1 $(if $3,--printed $3) --output $1 $2
endef

# 2400 Hz is where P2000 shows two branches at 150 N m; of a scene it is its first torque and the speed with the largest RMS.
digits := 0 1 2 3 4 5 6 7 8 9
animation_frames := $(wordlist 2,49,$(foreach t,0 1 2 3 4,$(foreach u,$(digits),0$t$u)))
define animation_rule # path without extension, scene, torque, options, what else it depends on
$(call together,$1.tsv $1.gif $(animation_frames:%=$1-%.png)) &: $(call of_gears,$2,mesh) out/$2/T$3/down/sweep.h5 out/$2/params/title.txt $5 \
    pipelines/plots/animation.gp pipelines/plots/common.gp $(call id,gear-animate) | $(B)/bin/gear-animate $(with_deps)
	$$(call run,animate) $(call named,--mesh,$2,mesh) \
	  --sweep out/$2/T$3/down/sweep.h5 $4 --frames $(words $(animation_frames)) --output $1 $$(call landed,animate)
endef

# A report shows what there is of a pair: with teeth that differ no figure of one mesh period, with a crack no motion.
teeth = $(filter $2,$(SCENE_$1_TEETH))
# BRANCHES=yes: with the branch at the first torque, which takes about as long as four sweeps.
BRANCHES ?= no
$(if $(filter-out yes no,$(BRANCHES)),$(error BRANCHES=$(BRANCHES): it is yes or no))
report_shows = fig01 $(if $(filter yes,$(SCENE_$1_MODIFIED)),profile-chart) \
  $(if $(call teeth,$1,alike),fig12 fig13 load-sharing error-budget) \
  $(if $(call teeth,$1,cracked),$(if $(call teeth,$1,differ),,crack),fig07 \
  $(if $(call teeth,$1,alike),$(if $(filter yes,$(BRANCHES)),fig05-branches multipliers)) order-cuts waterfall tooth-loads $(if $(call teeth,$1,alike),root-stress) \
  $(if $(filter yes,$(SCENE_$1_FRICTION)),efficiency) $(if $(filter elastic,$(SCENE_$1_BEARINGS)),bearing-forces) $(if $(call teeth,$1,differ),sidebands))
report_artifacts = $(foreach t,$2,out/$1/T$t/static.h5) $(call impacts,$1,$2) \
  $(if $(call teeth,$1,cracked),,$(call both_ways,$1,$2,response)) $(if $(call teeth,$1,alike),out/$1/T$(firstword $2)/error_budget.h5)
report_inputs = $(call report_artifacts,$1,$(SCENE_$1_TORQUES)) $(patsubst %,out/$1/report/%.png,$(report_shows))

define report_rule # scene
$(call together,out/$1/report/index.html out/$1/report/results.tsv) &: $(report_inputs) out/$1/params/title.txt $(B)/scenes/$1.mk $(call id,gear-report) | $(B)/bin/gear-report $(with_deps)
	$(B)/bin/gear-report --output out/$1/report/index.html $(report_inputs)
endef

# What the teeth suffer at one torque: that of its figures, the first of SCENE or the paper's.
teeth_shows = root-stress $(if $(filter yes,$(BRANCHES)),root-stress-branches) flank-pressure load-sharing tooth-loads error-budget
teeth_inputs = $(call report_artifacts,$1,$3) $(patsubst %,$2/%.png,$(teeth_shows))
define teeth_rule # scene, folder of its figures, torque, folder of the page
$4/index.html: $(call teeth_inputs,$1,$2,$3) out/$1/params/title.txt $(B)/scenes/$1.mk $(call id,gear-report) | $(B)/bin/gear-report $(with_deps)
	$(B)/bin/gear-report --teeth --output $4/index.html $(call teeth_inputs,$1,$2,$3)
endef
teeth_page := out/$(if $(SCENE),$(basename $(notdir $(SCENE))),figures)/teeth/index.html

# The fragment of a scene says its torques: a report depends on the list, too, not only on what stands at each.
define figure_rules # scene; needs its fragment
$(if $(filter $(paper_scene),$1),\
  $(foreach f,$(figures),$(eval $(call figure_rule,$f,out/figures/$f,$(call inputs_of_paper,$f)))) \
  $(eval $(call table_rule,out/figures/table1,$(call inputs_of_paper,table1),$(printed_claims))))
$(if $(filter $(calibrated_scene),$1),\
  $(eval $(call animation_rule,out/figures/animation/motion,$1,150,--mesh-frequency 2400)))
$(eval $(call animation_rule,out/$1/report/animation/motion,$1,$(firstword $(SCENE_$1_TORQUES)),,$(B)/scenes/$1.mk))
$(foreach f,$(report_figures) $(other_figures),\
  $(eval $(call figure_rule,$f,out/$1/report/$f,$(call inputs_$f,$1,$(SCENE_$1_TORQUES)),$(B)/scenes/$1.mk)))
$(if $(filter histories,$(goals)),$(if $(filter $1,$(own_scene)),$(foreach f,$(history_figures),\
  $(eval $(call figure_rule,$(firstword $(subst -$(AT)Hz, ,$(notdir $f))),$f,$(call inputs_fig08,$1,$(TORQUE)))))))
$(if $(filter sound,$(goals)),$(if $(filter $1,$(own_scene)),$(eval $(call sound_rule,$(call sound_inputs,$1)))\
  $(if $(TRANSFER),$(eval $(call plan_rule,$(sound_plan_file),$(sound_plan))))))
$(if $(filter export,$(goals)),$(if $(filter $1,$(own_scene)),$(eval $(call export_rule,$(call export_inputs,$1,$(SCENE_$1_TORQUES))))\
  $(eval $(call plan_rule,$(export_plan_file),$(export_plan)))))
$(if $(filter runup,$(goals)),$(if $(filter $1,$(own_scene)),$(eval $(call figure_rule,runup-$(WAY),$(runup_figure),$(call inputs_runup,$1)))))
$(eval $(call report_rule,$1))
$(eval $(call teeth_rule,$1,out/$1/report,$(firstword $(SCENE_$1_TORQUES)),out/$1/teeth))
$(if $(filter $(paper_scene),$1),$(eval $(call teeth_rule,$1,out/figures,$(paper_torques_root-stress),out/figures/teeth)))
$(eval $(call table_rule,out/$1/report/table1,$(call inputs_table1,$1,$(SCENE_$1_TORQUES)),,$(B)/scenes/$1.mk))
endef

figure_folder := $(if $(SCENE),out/$(basename $(notdir $(SCENE)))/report,out/figures)

# $(call stands,words): where a goal is to be found, also when nothing was to be made. By $(info): `make -q` and `make -n` stay as they are.
stands = $(if $(findstring n,$(firstword -$(MAKEFLAGS)))$(findstring q,$(firstword -$(MAKEFLAGS))),,$(info $1))

.PHONY: figures teeth $(figures) table1 scorecard animation report export histories sound runup
report: out/$$(own_scene)/report/index.html ## figures, tables and one HTML page of SCENE (default: the paper's), out/<scene>/report/index.html; BRANCHES=yes
	$(call stands,report: open $< in a browser; results.tsv beside it holds its numbers)
export: $(if $(filter export,$(goals)),$$(export_file)) ## results of SCENE as custom attributes of a copy of the REXS model that it was imported from: MODEL=stage.rexs STAGE=12 (id or name; where it has several)
	$(call stands,export: $(export_file))
$(figures): %: $(foreach e,tsv svg png,$(figure_folder)/%.$e)
teeth: $(teeth_page) ## what the teeth of a pair suffer, on one page, out/figures/teeth/index.html (SCENE: out/<scene>/teeth/index.html): root stress, flank pressure, dynamic factors, losses beside ISO 6336, 150 N m (SCENE: its first torque); BRANCHES=yes
	$(call stands,teeth: open $< in a browser)
figures: $(if $(SCENE),$(report_figures),$(paper_figures)) $(figure_folder)/table1.txt ## all figures and tables of the paper that are there so far, or all of SCENE
fig01: ## the finite element mesh of the pair
fig03: ## the contact zone: candidate pairs, inner and outer region, strips and their pressure, 150 N m (SCENE: its first torque)
fig05: ## RMS of the dynamic transmission error against mesh frequency, speed up and down, 150 N m (SCENE: its first torque)
fig07: ## the same at 100, 200 and 300 N m (SCENE: its torques)
fig05-branches: ## fig05 with the unstable orbits, dashed, and the folds at which branches end
fig07-branches: ## fig07 with the same
multipliers: ## Floquet multipliers of the branch in the complex plane, 150 N m (SCENE: its first torque)
fig07-600: ## RMS of the dynamic transmission error against mesh frequency at 300 and 600 N m
fig08: ## dynamic transmission error over time and its spectrum, both branches at 2400 Hz, 150 N m
fig09: ## the same at 1300 Hz
fig10: ## tooth loads over the mesh phase, both branches at 2400 Hz, 150 N m
fig11: ## the same at 1300 Hz
fig12: ## static transmission error over a mesh period and its spectrum
fig13: ## mesh stiffness over a mesh period and its spectrum
fig14: ## lumped model, rectangular stiffness: RMS and mean of the transmission error against mesh frequency
fig14-elastic: ## RMS and mean of the dynamic transmission error of the elastic pair at 100, 200 and 300 N m (SCENE: its torques)
fig15: ## lumped model, rectangular stiffness: net mesh force on the upper and the lower branch, 150 N m
fig16: ## lumped model, stiffness of the statics at each torque: RMS and mean of the transmission error
table1: $(figure_folder)/table1.txt ## natural frequencies by ring-down at 100, 200 and 300 N m beside those of the paper (SCENE: its torques)
	@cat $<
scorecard: out/figures/scorecard.txt ## every number and statement of the paper, its value in three scenes of its pair, whether it agrees
	@cat $<
load-sharing: ## the share of the load that a tooth pair carries on its way through the mesh, and the loads over a mesh period, at rest
waterfall: ## spectra of the dynamic transmission error against mesh frequency, rising and falling, and its first orders, 150 N m (SCENE: its first torque)
order-cuts: ## order cuts: the first orders of the dynamic transmission error against speed, rising and falling, 150 N m (SCENE: its first torque)
tooth-loads: ## tooth loads against mesh frequency, and over the mesh period at the resonance, 150 N m (SCENE: its first torque)
root-stress: ## root stress over the mesh cycle and over speed, dynamic factors beside K_v of ISO 6336-1, 150 N m (SCENE: its first torque)
root-stress-branches: ## root-stress with the unstable orbits of the branch
flank-pressure: ## flank pressure over roll angle and speed, both ways, and what tip edges carry, 150 N m (SCENE: its first torque)
efficiency: ## losses by friction and efficiency against speed and torque, moments of friction over a mesh period, 100 to 300 N m of fzg-c-friction (SCENE with [friction]: its torques)
bearing-forces: ## forces on elastic bearings against mesh frequency, 150 N m of parker2000-bearings (SCENE: its first torque)
profile-chart: ## what is taken off the driving flanks, as an inspection sheet shows it, of the paper's pair with relief from 20.9 deg (SCENE: of its gears)
relief-jumps: ## which jumps of Figure 5 remain with 10 micrometres of tip relief, at both dampings, 150 N m
error-budget: ## what refining each discretisation of the static stage alone changes, and what other choices change, 150 N m (SCENE: its first torque)
sidebands: ## teeth that differ: transmission error over the hunting period, shaft orders and sidebands, 150 N m of parker2000-grade5 (SCENE: its first torque)
crack: ## a cracked tooth: static transmission error with and without it, orders, 150 N m of parker2000-crack (SCENE: its first torque)
histories: $(if $(filter histories,$(goals)),$$(addsuffix .png,$$(history_figures))) ## DTE over time, its spectrum and the tooth loads at one mesh frequency in Hz, both branches: AT=1250 TORQUE=150 (SCENE: its first torque)
	$(call stands,histories: $(addsuffix .{png$(,)svg$(,)tsv},$(history_figures)))
sound: $(if $(filter sound,$(goals)),$$(sound_file).wav) ## what is heard of the mesh force at one mesh frequency in Hz, rising branch, then falling, as WAV: AT=2400; or of a run-up, then a run-down: RATE=100 (rpm/s) FROM=2400 TO=2800; TORQUE=150 TRANSFER=file.csv (SCENE: its first torque)
	$(call stands,sound: $(sound_file).{wav$(,)tsv})
runup: $(if $(filter runup,$(goals)),$$(runup_figure).png) ## run-up or run-down: spectrogram of the mesh force, orders of the DTE, tooth loads: RATE=100 (rpm/s) WAY=up FROM=2400 TO=2800 (Hz; else the scene's speeds) TORQUE=150 (SCENE: its first torque)
	$(call stands,runup: $(runup_figure).{png$(,)svg$(,)tsv})
animation: $(figure_folder)/animation/motion.gif ## one mesh period with contact loss, GIF and a PNG of each frame, 150 N m, 2400 Hz, upper branch of parker2000-calibrated (SCENE: first torque, at resonance)

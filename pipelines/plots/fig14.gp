# Figure 14: as Figure 16, of another model.
load system("dirname " . ARG0) . "/fig16.gp"

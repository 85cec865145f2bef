# Rows of one model in one scene: awk -F, -v scene=… -v model=… -f series.awk FILE FILE, the same file twice.
# Of a trained model with several numbers of modes, the row with the most.
$1 != scene || $2 != model { next }
FNR == NR { if (!($5 in most) || $4 > most[$5]) most[$5] = $4; next }
$4 == most[$5]

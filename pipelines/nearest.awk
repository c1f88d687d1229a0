# Words of standard input that are near in spelling to `word`, the nearest first: "report" for "raport".
function distance(a, b,    i, j, row, above, diagonal, least) {
  for (j = 0; j <= length(b); j++) row[j] = j
  for (i = 1; i <= length(a); i++) {
    diagonal = row[0]; row[0] = i
    for (j = 1; j <= length(b); j++) {
      above = row[j]
      least = diagonal + (substr(a, i, 1) != substr(b, j, 1))
      if (row[j] + 1 < least) least = row[j] + 1
      if (row[j - 1] + 1 < least) least = row[j - 1] + 1
      row[j] = least; diagonal = above
    }
  }
  return row[length(b)]
}
{ d = distance(word, $1)
  if (d <= length(word) / 3 + 1 || index($1, word) == 1) near[d] = near[d] " " $1 }
END { for (d = 0; d < 40; d++) if (near[d]) { n = split(near[d], words, " "); for (i = 1; i <= n; i++) print words[i] } }

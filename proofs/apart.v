(* Certificates that bodies stay apart (docs/proofs.md, "The theorem"), for items of one piece of
   motion: a tree that is accepted keeps two items of different bodies apart at every time of its
   interval. `make coq` compiles this file and prints the axioms that the theorems need.

   Cut: moving lines with strips, splits of time and of bodies, over any ordered field.
   Bernstein: a polynomial has the sign of all its Bernstein coefficients.
   Tracks: rational tracks, and the checker as a function that decides by signs. *)
From mathcomp Require Import all_ssreflect all_algebra.
From mathcomp Require Import ring.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory Order.TTheory.
Local Open Scope ring_scope.

Section Cut.
Variable R : realFieldType.
Definition pt := (R * R)%type.
Definition dot (n p : pt) : R := n.1 * p.1 + n.2 * p.2.
Definition sub (q p : pt) : pt := (q.1 - p.1, q.2 - p.2).

(* p is on the closed segment from a to b. *)
Definition seg (a b p : pt) := exists l : R,
  [/\ 0 <= l, l <= 1, p.1 = (1 - l) * a.1 + l * b.1 & p.2 = (1 - l) * a.2 + l * b.2].

Lemma dot_seg n a b p : seg a b p ->
  exists l, [/\ 0 <= l, l <= 1 & dot n p = (1 - l) * dot n a + l * dot n b].
Proof.
case=> l [l0 l1 e1 e2]; exists l; split=> //.
by rewrite /dot e1 e2; ring.
Qed.

Lemma seg_lt n a b p c : seg a b p -> dot n a < c -> dot n b < c -> dot n p < c.
Proof.
move=> /(dot_seg n) [l [l0 l1 ->]] ha hb.
have h1 : 0 <= 1 - l by rewrite subr_ge0.
have -> : c = (1 - l) * c + l * c by ring.
case: (eqVneq l 0) => [->|ln0].
  by rewrite !mul0r !addr0 subr0 !mul1r.
apply: ler_lt_add; first by apply: ler_wpmul2l => //; exact: ltW.
by rewrite ltr_pmul2l // lt_neqAle eq_sym ln0.
Qed.

Lemma seg_ge n a b p c : seg a b p -> c <= dot n a -> c <= dot n b -> c <= dot n p.
Proof.
move=> /(dot_seg n) [l [l0 l1 ->]] ha hb.
have h1 : 0 <= 1 - l by rewrite subr_ge0.
have -> : c = (1 - l) * c + l * c by ring.
by apply: ler_add; apply: ler_wpmul2l.
Qed.

(* The width of a strip in the direction n is more than |n| d, d >= 0: points on its two sides
   are farther apart than d. By squares, since a field has no roots. *)
Lemma cauchy (n q : pt) : dot n q ^+ 2 <= dot n n * dot q q.
Proof.
rewrite -subr_ge0 /dot.
have -> : (n.1 * n.1 + n.2 * n.2) * (q.1 * q.1 + q.2 * q.2) - (n.1 * q.1 + n.2 * q.2) ^+ 2
        = (n.1 * q.2 - n.2 * q.1) ^+ 2 by ring.
exact: sqr_ge0.
Qed.

Lemma strip_sound n d w p q : 0 <= d -> 0 <= w -> dot n n <= w ^+ 2 ->
  w * d < dot n (sub q p) -> d ^+ 2 < dot (sub q p) (sub q p).
Proof.
set r := sub q p => d0 w0 hw far.
have nr0 : 0 <= w * d by exact: mulr_ge0.
have h1 : (w * d) ^+ 2 < dot n r ^+ 2.
  by rewrite ltr_sqr // nnegrE // ltW //; exact: le_lt_trans far.
have h2 := lt_le_trans h1 (cauchy n r).
have rr0 : 0 <= dot r r by rewrite /dot -!expr2; apply: addr_ge0; exact: sqr_ge0.
have h3 : (w * d) ^+ 2 < w ^+ 2 * dot r r.
  by apply: lt_le_trans h2 _; apply: ler_wpmul2r.
rewrite exprMn in h3.
have w2 : 0 < w ^+ 2.
  rewrite lt_neqAle sqr_ge0 andbT; apply/eqP => w2; by move: h3; rewrite -w2 !mul0r ltxx.
by rewrite ltr_pmul2l in h3.
Qed.

(* The tree. At a time t an item i is the segment between its ends; `r i` is the radius of its
   body, D the distance that is claimed. *)
Variables (I : finType) (body : I -> nat) (r : I -> R) (ends : I -> R -> pt * pt) (D : R).
Hypotheses (r0 : forall i, 0 <= r i) (D0 : 0 <= D).

(* No points of two items are within the sum of the radii and the distance, at the time t. *)
Definition apart (t : R) (i j : I) := forall p q,
  seg (ends i t).1 (ends i t).2 p -> seg (ends j t).1 (ends j t).2 q ->
  (r i + r j + D) ^+ 2 < dot (sub q p) (sub q p).

(* On one side of a moving line, throughout an interval: what Bernstein coefficients show. *)
Definition below n w c v s e i := forall t, s <= t <= e ->
  dot n (ends i t).1 < c + v * t - w * r i /\ dot n (ends i t).2 < c + v * t - w * r i.
Definition above n w c v s e i := forall t, s <= t <= e ->
  c + v * t + w * (r i + D) <= dot n (ends i t).1 /\
  c + v * t + w * (r i + D) <= dot n (ends i t).2.

Inductive tree :=
  | Leaf
  | Time of R & tree & tree                        (* t Q *)
  | Body of nat & {set I} & tree & tree            (* s I K: the items of a body that go left *)
  | Line of pt & R & R & R & {set I} & {set I} & tree & tree.  (* c: those of both children *)

(* The tree is accepted for a set of items in an interval. *)
Fixpoint ok (T : tree) (S : {set I}) (s e : R) : Prop :=
  match T with
  | Leaf => forall i j, i \in S -> j \in S -> body i = body j
  | Time q l g => ok l S s q /\ ok g S q e
  | Body k L l g =>
      ok l [set i in S | (body i != k) || (i \in L)] s e /\
      ok g [set i in S | (body i != k) || (i \notin L)] s e
  | Line n w c v X Y l g =>
      [/\ [/\ 0 <= w, dot n n <= w ^+ 2 & S \subset X :|: Y],
          forall i, i \in S :\: Y -> below n w c v s e i,
          forall i, i \in S :\: X -> above n w c v s e i,
          ok l X s e & ok g Y s e]
  end.

Lemma apart_sym t i j : apart t i j -> apart t j i.
Proof.
move=> h p q sp sq; have := h q p sq sp.
by rewrite [r i + r j]addrC /dot /sub /=; set x := (X in X < _);
   rewrite -[p.1 - q.1]opprB -[p.2 - q.2]opprB !mulrNN.
Qed.

Lemma line_sound n w c v s e i j t : 0 <= w -> dot n n <= w ^+ 2 -> s <= t <= e ->
  below n w c v s e i -> above n w c v s e j -> apart t i j.
Proof.
move=> w0 hw ht /(_ t ht) [b1 b2] /(_ t ht) [a1 a2] p q sp sq.
have lo := seg_lt sp b1 b2; have hi := seg_ge sq a1 a2.
apply: (strip_sound _ w0 hw); first by rewrite !addr_ge0.
have -> : dot n (sub q p) = dot n q - dot n p by rewrite /dot /sub /=; ring.
have -> : w * (r i + r j + D) = (c + v * t + w * (r j + D)) - (c + v * t - w * r i) by ring.
exact: ler_lt_sub.
Qed.

Theorem tree_sound T : forall S s e, ok T S s e ->
  forall i j t, i \in S -> j \in S -> body i != body j -> s <= t <= e -> apart t i j.
Proof.
elim: T => [|q l IHl g IHg|k L l IHl g IHg|n w c v X Y l IHl g IHg] S s e /=.
- by move=> h i j t iS jS /eqP; case; exact: h.
- case=> okl okg i j t iS jS ij /andP[st te].
  have [tq|qt] := leP t q; first by apply: (IHl _ _ _ okl) => //; rewrite st.
  by apply: (IHg _ _ _ okg) => //; rewrite te (ltW qt).
- case=> okl okg i j t iS jS ij ht.
  have both : forall a, a \in S -> body a != k -> forall P : pred I,
      a \in [set x in S | (body x != k) || P x] by move=> a aS ak P; rewrite inE aS ak.
  have [ik|ik] := eqVneq (body i) k.
    have jk : body j != k by rewrite -ik eq_sym.
    have [iL|iL] := boolP (i \in L).
      by apply: (IHl _ _ _ okl) => //; rewrite inE ?iS ?jS ?iL ?jk ?orbT.
    by apply: (IHg _ _ _ okg) => //; rewrite inE ?iS ?jS ?iL ?jk ?orbT.
  have [jL|jL] := boolP (j \in L).
    by apply: (IHl _ _ _ okl) => //; rewrite inE ?iS ?jS ?jL ?ik ?orbT.
  by apply: (IHg _ _ _ okg) => //; rewrite inE ?iS ?jS ?jL ?ik ?orbT.
- case=> [[w0 hw cover] lo hi okl okg] i j t iS jS ij ht.
  have inXY a : a \in S -> (a \in X) || (a \in Y) by move=> aS; rewrite -in_setU (subsetP cover).
  have notY a : a \in S -> a \notin Y -> below n w c v s e a.
    by move=> aS aY; apply: lo; rewrite inE aY.
  have notX a : a \in S -> a \notin X -> above n w c v s e a.
    by move=> aS aX; apply: hi; rewrite inE aX.
  have [iX|iX] := boolP (i \in X); have [jX|jX] := boolP (j \in X).
  + exact: (IHl _ _ _ okl).
  + have [iY|iY] := boolP (i \in Y); last exact: (line_sound w0 hw ht (notY _ iS iY) (notX _ jS jX)).
    by apply: (IHg _ _ _ okg) => //; have := inXY _ jS; rewrite (negPf jX).
  + have [jY|jY] := boolP (j \in Y).
      by apply: (IHg _ _ _ okg) => //; have := inXY _ iS; rewrite (negPf iX).
    by apply: apart_sym; exact: (line_sound w0 hw ht (notY _ jS jY) (notX _ iS iX)).
  + apply: (IHg _ _ _ okg) => //; first by have := inXY _ iS; rewrite (negPf iX).
    by have := inXY _ jS; rewrite (negPf jX).
Qed.
End Cut.

(* All Bernstein coefficients positive implies positive. *)
Section Bernstein.
Variable R : realFieldType.
Implicit Types (p q : {poly R}) (x y a b c : R) (l : seq R).

(* A form of degree n in x and y, with the coefficients of q. With x = 1 - u, y = u its
   coefficients are those in the Bernstein basis, times binomials. *)
Definition form n q x y : R := \sum_(k < n.+1) q`_k * (x ^+ (n - k) * y ^+ k).

Lemma form_gt0 n q x y : 0 <= x -> 0 <= y -> 0 < x + y ->
  (forall k, (k <= n)%N -> 0 < q`_k) -> 0 < form n q x y.
Proof.
move=> x0 y0 xy q0.
have ge0 k : (k <= n)%N -> 0 <= q`_k * (x ^+ (n - k) * y ^+ k).
  by move=> kn; rewrite mulr_ge0 ?mulr_ge0 ?exprn_ge0 // ltW // q0.
have [x_eq0|x_neq0] := eqVneq x 0.
  rewrite /form big_ord_recr /=; apply: ltr_paddl; first by apply: sumr_ge0 => k _; apply: ge0; exact: ltnW.
  have y1 : 0 < y by rewrite x_eq0 add0r in xy.
  by rewrite subnn expr0 mul1r mulr_gt0 ?exprn_gt0 ?q0.
rewrite /form big_ord_recl /=; apply: ltr_paddr; first by apply: sumr_ge0 => k _; apply: ge0.
have x1 : 0 < x by rewrite lt_neqAle eq_sym x_neq0.
by rewrite subn0 expr0 mulr1 mulr_gt0 ?exprn_gt0 ?q0.
Qed.

Lemma form_ge0 n q x y : 0 <= x -> 0 <= y ->
  (forall k, (k <= n)%N -> 0 <= q`_k) -> 0 <= form n q x y.
Proof.
move=> x0 y0 q0; apply: sumr_ge0 => k _.
by rewrite mulr_ge0 ?mulr_ge0 ?exprn_ge0 ?q0 // -ltnS.
Qed.

Lemma formD n p q x y : form n (p + q) x y = form n p x y + form n q x y.
Proof. by rewrite /form -big_split; apply: eq_bigr => k _; rewrite coefD mulrDl. Qed.

Lemma form_line n q a b x y : (size q <= n.+1)%N ->
  form n.+1 ((a%:P + b *: 'X) * q) x y = (a * x + b * y) * form n q x y.
Proof.
move=> size_q.
have -> : (a%:P + b *: 'X) * q = a *: q + b *: (q * 'X).
  by rewrite mulrDl mul_polyC -scalerAl [_ * q]mulrC.
rewrite formD mulrDl; congr (_ + _).
  rewrite /form big_ord_recr /= coefZ nth_default // mulr0 mul0r addr0 mulr_sumr.
  apply: eq_bigr => k _; rewrite /= coefZ subSn -1?ltnS // exprS.
  by rewrite -!mulrA; congr (_ * _); rewrite !mulrA [x * q`_k]mulrC.
rewrite /form big_ord_recl /= coefZ coefMX /= mulr0 mul0r add0r mulr_sumr.
apply: eq_bigr => k _; rewrite coefZ coefMX /= subSS exprS.
by rewrite -!mulrA; congr (_ * _); rewrite [RHS]mulrCA; congr (_ * _); rewrite mulrCA.
Qed.

(* The coefficients on [a, b] of the polynomial with the coefficients l, by Horner's rule, as
   the checker computes them: t = a x + b y with x + y = 1. *)
Fixpoint spread a b l : {poly R} :=
  if l is c :: l' then c *: (1%:P + 1 *: 'X) ^+ size l' + (a%:P + b *: 'X) * spread a b l' else 0.

Lemma size_line a b q n : (size q <= n)%N -> (size ((a%:P + b *: 'X) * q)%R <= n.+1)%N.
Proof.
move=> h; have -> : (a%:P + b *: 'X) * q = a *: q + b *: (q * 'X).
  by rewrite mulrDl mul_polyC -scalerAl [_ * q]mulrC.
rewrite (leq_trans (size_add _ _)) // geq_max; apply/andP; split.
  exact: leq_trans (size_scale_leq _ _) (leqW h).
rewrite (leq_trans (size_scale_leq _ _)) // (leq_trans (size_mul_leq _ _)) // size_polyX addn2 /= ltnS //.
Qed.

Lemma form_units n x y : form n ((1%:P + 1 *: 'X) ^+ n) x y = (x + y) ^+ n /\
  (size ((1%:P + 1 *: 'X : {poly R}) ^+ n)%R <= n.+1)%N.
Proof.
elim: n => [|n [IH h]].
  by rewrite /form big_ord1 !expr0 coefC /= !mulr1 size_polyC_leq1.
rewrite !exprS form_line // IH !mul1r; split=> //; exact: size_line.
Qed.

Lemma spread_size a b l : (size (spread a b l) <= size l)%N.
Proof.
elim: l => [|c l IH] /=; first by rewrite size_poly0.
rewrite (leq_trans (size_add _ _)) // geq_max size_line // andbT.
by rewrite (leq_trans (size_scale_leq _ _)) //; case: (form_units (size l) 0 0).
Qed.

Lemma formZ n c q x y : form n (c *: q) x y = c * form n q x y.
Proof. by rewrite /form mulr_sumr; apply: eq_bigr => k _; rewrite coefZ -mulrA. Qed.

Lemma form_spread a b c l x y : x + y = 1 ->
  form (size l) (spread a b (c :: l)) x y = (Poly (c :: l)).[a * x + b * y].
Proof.
move=> xy; elim: l c => [|d l IH] c.
  rewrite /= expr0 mulr0 addr0 formZ /form big_ord1 coefC /= !expr0 !mulr1.
  by rewrite cons_poly_def mul0r add0r hornerC.
rewrite [spread _ _ _]/= -/(spread a b (d :: l)) formD formZ.
case: (form_units (size l).+1 x y) => -> _.
rewrite xy expr1n mulr1 form_line; last exact: (spread_size a b (d :: l)).
rewrite IH [Poly (c :: _)]/= cons_poly_def hornerD hornerMX hornerC.
by rewrite [RHS]addrC; congr (_ + _); rewrite mulrC.
Qed.

Lemma weights a b t : a < b -> a <= t <= b ->
  exists x y, [/\ 0 <= x, 0 <= y, x + y = 1 & t = a * x + b * y].
Proof.
move=> ab /andP[at_ tb]; have d0 : 0 < b - a by rewrite subr_gt0.
have dn : b - a != 0 by rewrite gt_eqF.
exists ((b - t) / (b - a)), ((t - a) / (b - a)); split.
- by rewrite divr_ge0 ?subr_ge0 // ltW.
- by rewrite divr_ge0 ?subr_ge0 // ltW.
- by rewrite -mulrDl addrA subrK divff.
have -> : a * ((b - t) / (b - a)) + b * ((t - a) / (b - a)) = (a * (b - t) + b * (t - a)) / (b - a).
  by rewrite !mulrA -mulrDl.
have -> : a * (b - t) + b * (t - a) = t * (b - a) by ring.
by rewrite mulfK.
Qed.

(* All of them of one sign, so is the polynomial throughout [a, b]. *)
Theorem spread_gt0 a b c l t : a < b -> a <= t <= b ->
  all (fun k => 0 < (spread a b (c :: l))`_k) (iota 0 (size l).+1) -> 0 < (Poly (c :: l)).[t].
Proof.
move=> ab ht /allP pos; have [x [y [x0 y0 xy ->]]] := weights ab ht.
rewrite -form_spread //; apply: form_gt0 => //; first by rewrite xy ltr01.
by move=> k kn; apply: pos; rewrite mem_iota.
Qed.

Theorem spread_ge0 a b c l t : a < b -> a <= t <= b ->
  all (fun k => 0 <= (spread a b (c :: l))`_k) (iota 0 (size l).+1) -> 0 <= (Poly (c :: l)).[t].
Proof.
move=> ab ht /allP pos; have [x [y [x0 y0 xy ->]]] := weights ab ht.
by rewrite -form_spread //; apply: form_ge0 => // k kn; apply: pos; rewrite mem_iota.
Qed.
End Bernstein.

(* Items whose ends move on rational tracks, (x, y) / w, in one piece of their motion; the signs
   of coefficients decide on which side of a line they are. *)
Section Tracks.
Variable R : realFieldType.
Record track := Track { tx : seq R; ty : seq R; tw : seq R }.
Definition place (k : track) (t : R) : pt R :=
  ((Poly (tx k)).[t] / (Poly (tw k)).[t], (Poly (ty k)).[t] / (Poly (tw k)).[t]).

(* All coefficients on [s, e] of the polynomial with these coefficients are positive; or none is
   negative. *)
Definition is_positive s e (l : seq R) := [&& l != [::], s < e &
  all (fun k => 0 < (spread s e l)`_k) (iota 0 (size l))].
Definition is_natural s e (l : seq R) := [&& l != [::], s < e &
  all (fun k => 0 <= (spread s e l)`_k) (iota 0 (size l))].

Lemma is_positive_gt0 s e l t : is_positive s e l -> s <= t <= e -> 0 < (Poly l).[t].
Proof. by case: l => [|c l] /and3P[//] _ se pos st; apply: (spread_gt0 se st). Qed.
Lemma is_natural_ge0 s e l t : is_natural s e l -> s <= t <= e -> 0 <= (Poly l).[t].
Proof. by case: l => [|c l] /and3P[//] _ se pos st; apply: (spread_ge0 se st). Qed.

(* w (c + v t - n.p), as a list of coefficients; zeros at its end are of the formal degree that
   the checker takes, whichever that is. *)
Variable pad : pt R -> R -> R -> track -> nat.
Definition gap (n : pt R) (c v : R) (k : track) : seq R := polyseq
  ((c%:P + v *: 'X) * Poly (tw k) - n.1 *: Poly (tx k) - n.2 *: Poly (ty k))
  ++ nseq (pad n c v k) 0.

Lemma Poly_padded (q : {poly R}) m : Poly (q ++ nseq m 0) = q.
Proof.
apply/polyP => i; rewrite coef_Poly nth_cat nth_nseq; case: ltnP => // h.
by rewrite if_same nth_default.
Qed.

Lemma gap_at n c v k t : 0 < (Poly (tw k)).[t] ->
  (Poly (gap n c v k)).[t] = (Poly (tw k)).[t] * (c + v * t - dot n (place k t)).
Proof.
move=> w0; have wn : (Poly (tw k)).[t] != 0 by rewrite gt_eqF.
rewrite /gap Poly_padded !hornerE /dot /place /=.
set w := (Poly (tw k)).[t] in wn *; set x := (Poly (tx k)).[t]; set y := (Poly (ty k)).[t].
have ex : x = w * (x / w) by rewrite mulrCA divff ?mulr1.
have ey : y = w * (y / w) by rewrite mulrCA divff ?mulr1.
by rewrite [in LHS]ex [in LHS]ey; ring.
Qed.

Lemma gap_below n c v k s e t : is_positive s e (tw k) -> is_positive s e (gap n c v k) ->
  s <= t <= e -> dot n (place k t) < c + v * t.
Proof.
move=> wp gp st; have w0 := is_positive_gt0 wp st; have := is_positive_gt0 gp st.
by rewrite gap_at // pmulr_rgt0 // subr_gt0.
Qed.

Lemma gap_above n c v k s e t : is_positive s e (tw k) ->
  is_natural s e (map -%R (gap n c v k)) -> s <= t <= e -> c + v * t <= dot n (place k t).
Proof.
move=> wp gp st; have w0 := is_positive_gt0 wp st; have := is_natural_ge0 gp st.
have -> : Poly (map -%R (gap n c v k)) = - Poly (gap n c v k).
  by apply/polyP => i; rewrite coefN !coef_Poly; elim: (gap n c v k) i => [|a l IH] [|i] //=; rewrite ?oppr0.
by rewrite hornerN gap_at // oppr_ge0 pmulr_rle0 // subr_le0.
Qed.

Variables (I : finType) (body : I -> nat) (r : I -> R) (D : R) (tracks : I -> track * track).
Hypotheses (r0 : forall i, 0 <= r i) (D0 : 0 <= D).
Definition ends i t := (place (tracks i).1 t, place (tracks i).2 t).

Definition goes_below n w c v s e i :=
  [&& is_positive s e (tw (tracks i).1), is_positive s e (tw (tracks i).2),
      is_positive s e (gap n (c - w * r i) v (tracks i).1) &
      is_positive s e (gap n (c - w * r i) v (tracks i).2)].
Definition goes_above n w c v s e i :=
  [&& is_positive s e (tw (tracks i).1), is_positive s e (tw (tracks i).2),
      is_natural s e (map -%R (gap n (c + w * (r i + D)) v (tracks i).1)) &
      is_natural s e (map -%R (gap n (c + w * (r i + D)) v (tracks i).2))].

Lemma below_by_signs n w c v s e i : goes_below n w c v s e i -> below r ends n w c v s e i.
Proof.
case/and4P=> w1 w2 g1 g2 t st.
have e0 : c + v * t - w * r i = c - w * r i + v * t by ring.
by rewrite e0; split; [exact: (gap_below w1 g1 st) | exact: (gap_below w2 g2 st)].
Qed.

Lemma above_by_signs n w c v s e i : goes_above n w c v s e i -> above r ends D n w c v s e i.
Proof.
case/and4P=> w1 w2 g1 g2 t st.
have e0 : c + v * t + w * (r i + D) = c + w * (r i + D) + v * t by ring.
by rewrite e0; split; [exact: (gap_above w1 g1 st) | exact: (gap_above w2 g2 st)].
Qed.

(* The checker, as a function: it decides by signs alone. *)
Fixpoint accepts (T : tree R I) (S : {set I}) (s e : R) : bool :=
  match T with
  | Leaf => [forall i in S, forall j in S, body i == body j]
  | Time q l g => [&& s < q, q < e, accepts l S s q & accepts g S q e]
  | Body k L l g =>
      accepts l [set i in S | (body i != k) || (i \in L)] s e &&
      accepts g [set i in S | (body i != k) || (i \notin L)] s e
  | Line n w c v X Y l g =>
      [&& [&& 0 <= w, dot n n <= w ^+ 2 & S \subset X :|: Y],
          [forall i in S :\: Y, goes_below n w c v s e i],
          [forall i in S :\: X, goes_above n w c v s e i],
          accepts l X s e & accepts g Y s e]
  end.

Lemma accepts_ok T : forall S s e, accepts T S s e -> ok body r ends D T S s e.
Proof.
elim: T => [|q l IHl g IHg|k L l IHl g IHg|n w c v X Y l IHl g IHg] S s e /=.
- move=> /forallP h i j iS jS.
  by have /implyP/(_ iS)/forallP/(_ j)/implyP/(_ jS)/eqP := h i.
- by case/and4P=> _ _ /IHl ? /IHg ?.
- by case/andP=> /IHl ? /IHg ?.
- case/and5P=> /and3P[? ? ?] /forallP lo /forallP hi /IHl ? /IHg ?; split=> // i iS.
    by apply: below_by_signs; have /implyP/(_ iS) := lo i.
  by apply: above_by_signs; have /implyP/(_ iS) := hi i.
Qed.

Theorem certificate_sound T S s e i j t : accepts T S s e ->
  i \in S -> j \in S -> body i != body j -> s <= t <= e -> apart r ends D t i j.
Proof. by move=> /accepts_ok h; apply: (tree_sound r0 D0 h). Qed.
End Tracks.
Print Assumptions tree_sound.
Print Assumptions spread_gt0.
Print Assumptions certificate_sound.

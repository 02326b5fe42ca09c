;;; gable.el --- Rules of Gable with eglot -*- lexical-binding: t -*-
(require 'eglot)
(define-derived-mode gable-mode prog-mode "Gable"
  "Rules of Gable and grammars of other notations."
  (setq-local comment-start "// " comment-end "")
  (modify-syntax-entry ?/ ". 124b") (modify-syntax-entry ?* ". 23")
  (modify-syntax-entry ?\n "> b") (modify-syntax-entry ?_ "w"))
(add-to-list 'auto-mode-alist '("\\.\\(cga\\|gbbg\\|park\\|grammar\\|pg3d\\)\\'" . gable-mode))
(add-to-list 'eglot-server-programs '(gable-mode . ("gable" "lsp")))
(add-hook 'gable-mode-hook #'eglot-ensure)
(provide 'gable)

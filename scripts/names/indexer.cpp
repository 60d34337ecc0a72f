// Index of declarations and references of the project, one line each, for apply.py.
#include <clang/AST/RecursiveASTVisitor.h>
#include <clang/AST/ASTConsumer.h>
#include <clang/AST/ASTContext.h>
#include <clang/Frontend/CompilerInstance.h>
#include <clang/Frontend/FrontendAction.h>
#include <clang/Lex/Lexer.h>
#include <clang/Sema/Sema.h>
#include <clang/Sema/SemaConsumer.h>
#include <clang/Tooling/CompilationDatabase.h>
#include <clang/Tooling/Tooling.h>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
using namespace clang;

static std::string root;  // with trailing slash
static std::set<std::string> lines;

struct Visitor : RecursiveASTVisitor<Visitor> {
  using Base = RecursiveASTVisitor<Visitor>;
  ASTContext& ctx;
  SourceManager& sm;
  explicit Visitor(ASTContext& c) : ctx(c), sm(c.getSourceManager()) {}
  bool shouldVisitTemplateInstantiations() const { return true; }
  bool shouldVisitImplicitCode() const { return false; }

  std::string where(SourceLocation l) {
    if (l.isInvalid()) return {};
    l = sm.getSpellingLoc(l);
    auto [fid, off] = sm.getDecomposedLoc(l);
    const FileEntry* fe = sm.getFileEntryForID(fid);
    if (!fe) return {};
    auto& name = path(fe);
    if (name.empty()) return {};
    return name + ":" + std::to_string(off);
  }
  std::map<const FileEntry*, std::string> paths;
  const std::string& path(const FileEntry* fe) {
    auto it = paths.find(fe);
    if (it != paths.end()) return it->second;
    std::string p = fe->tryGetRealPathName().str();
    if (p.rfind(root, 0) != 0) p.clear();
    else p = p.substr(root.size());
    if (p.rfind("build/", 0) == 0) p.clear();
    return paths[fe] = p;
  }
  void put(std::string s) { lines.insert(std::move(s)); }

  static std::string space(const Decl* d) {  // the namespace that d is directly in; "-" for members and locals
    const DeclContext* c = d->getDeclContext();
    while (c->isTransparentContext() && !c->isTranslationUnit()) c = c->getParent();  // unscoped enums, extern "C"
    std::string r;
    if (c->isTranslationUnit()) return "::";
    if (!c->isNamespace()) return "-";
    while (!c->isTranslationUnit()) {
      if (auto* n = dyn_cast<NamespaceDecl>(c))
        r = (n->isAnonymousNamespace() ? std::string("(anon)") : n->getName().str()) + (r.empty() ? "" : "::" + r);
      c = c->getParent();
    }
    return r;
  }
  static const NamedDecl* canon(const NamedDecl* d) {
    if (auto* u = dyn_cast<UsingShadowDecl>(d)) d = u->getTargetDecl();
    if (auto* t = dyn_cast<TemplateDecl>(d)) if (t->getTemplatedDecl()) d = t->getTemplatedDecl();
    if (auto* f = dyn_cast<FunctionDecl>(d)) {
      if (auto* p = f->getTemplateInstantiationPattern()) d = p;
    } else if (auto* r = dyn_cast<CXXRecordDecl>(d)) {
      if (auto* p = r->getTemplateInstantiationPattern()) d = p;
      else if (auto* s = dyn_cast<ClassTemplateSpecializationDecl>(r)) { d = s->getSpecializedTemplate()->getTemplatedDecl(); }
    }
    return d;
  }
  void ref(SourceLocation l, const NamedDecl* d, char kind = 'R') {
    if (!d) return;
    d = canon(d);
    if (isa<CXXConstructorDecl>(d) || isa<CXXDestructorDecl>(d)) d = cast<CXXMethodDecl>(d)->getParent(), d = canon(d);
    if (!d->getIdentifier()) return;
    std::string t = where(d->getLocation());
    if (t.empty()) return;
    std::string w = where(l);
    if (w.empty()) return;
    put(std::string(1, kind) + "\t" + w + "\t" + t + "\t" + d->getName().str() + "\t" + space(d));
  }
  static const char* kind(const NamedDecl* d) {
    if (isa<ParmVarDecl>(d)) return "local";
    if (auto* v = dyn_cast<VarDecl>(d)) return v->isLocalVarDecl() ? "local" : v->isStaticDataMember() ? "member" : "variable";
    if (isa<BindingDecl>(d)) return "local";
    if (isa<FieldDecl>(d)) return "member";
    if (isa<CXXConstructorDecl>(d) || isa<CXXDestructorDecl>(d)) return "ctor";
    if (isa<CXXMethodDecl>(d)) return "method";
    if (isa<FunctionDecl>(d)) return "function";
    if (isa<EnumConstantDecl>(d)) return "enumerator";
    if (isa<TagDecl>(d)) return "type";
    if (isa<TypedefNameDecl>(d)) return "alias";
    if (isa<NamespaceDecl>(d)) return "namespace";
    if (isa<ConceptDecl>(d)) return "concept";
    return "other";
  }
  bool VisitNamedDecl(NamedDecl* d) {
    if (isa<UsingDecl>(d)) {
      for (auto* s : cast<UsingDecl>(d)->shadows()) ref(d->getLocation(), s->getTargetDecl());
      return true;
    }
    if (isa<UsingDirectiveDecl>(d) || isa<TemplateTypeParmDecl>(d) || isa<NonTypeTemplateParmDecl>(d)) return true;
    if (isa<TemplateDecl>(d) && !isa<ConceptDecl>(d)) return true;
    if (d->isImplicit()) return true;
    std::string w = where(d->getLocation());
    if (w.empty()) return true;
    if (isa<CXXConstructorDecl>(d)) { put("C\t" + w); ref(d->getLocation(), cast<CXXMethodDecl>(d)->getParent()); return true; }
    if (isa<CXXDestructorDecl>(d)) {
      if (auto* ti = cast<CXXDestructorDecl>(d)->getNameInfo().getNamedTypeInfo()) {
        auto b = ti->getTypeLoc().getBeginLoc();
        put("C\t" + where(b)); ref(b, cast<CXXMethodDecl>(d)->getParent());
      }
      return true;
    }
    if (!d->getIdentifier()) return true;
    if (d->getName().empty()) return true;
    const NamedDecl* c = cast<NamedDecl>(d->getCanonicalDecl());
    if (auto* r = dyn_cast<CXXRecordDecl>(d)) if (isa<ClassTemplateSpecializationDecl>(r)) {
      // explicit specialisation: the name is a reference to the template
      ref(d->getLocation(), cast<ClassTemplateSpecializationDecl>(r)->getSpecializedTemplate()->getTemplatedDecl(), 'R');
      put("C\t" + w);
      return true;
    }
    bool def = false;
    if (auto* f = dyn_cast<FunctionDecl>(d)) def = f->isThisDeclarationADefinition();
    else if (auto* t = dyn_cast<TagDecl>(d)) def = t->isThisDeclarationADefinition();
    else def = true;
    std::string k = kind(d);
    put("D\t" + w + "\t" + k + "\t" + d->getName().str() + "\t" + space(d) + "\t" + (def ? "def" : "decl") + "\t" +
        (k == "local" ? d->getName().str() : d->getQualifiedNameAsString()));
    std::string cw = where(c->getLocation());
    if (!cw.empty() && cw != w) put("S\t" + w + "\t" + cw);
    if (auto* f = dyn_cast<FunctionDecl>(d)) {
      if (auto* p = f->getTemplateInstantiationPattern()) { auto pw = where(p->getLocation()); if (!pw.empty() && pw != w) put("S\t" + w + "\t" + pw); }
    }
    if (auto* m = dyn_cast<CXXMethodDecl>(d))
      for (auto* o : m->overridden_methods()) { auto ow = where(o->getLocation()); put(ow.empty() ? "X\t" + w : "S\t" + w + "\t" + ow); }
    return true;
  }
  bool VisitDeclRefExpr(DeclRefExpr* e) { ref(e->getNameInfo().getLoc(), e->getDecl()); return true; }
  bool VisitMemberExpr(MemberExpr* e) { ref(e->getMemberLoc(), e->getMemberDecl()); return true; }
  bool VisitOverloadExpr(OverloadExpr* e) {
    for (auto* d : e->decls()) ref(e->getNameLoc(), d->getUnderlyingDecl(), 'L');
    return true;
  }
  bool VisitCXXDependentScopeMemberExpr(CXXDependentScopeMemberExpr* e) {
    if (auto* id = e->getMember().getAsIdentifierInfo()) { auto w = where(e->getMemberLoc()); if (!w.empty()) put("U\t" + w + "\t" + id->getName().str()); }
    return true;
  }
  bool VisitDesignatedInitExpr(DesignatedInitExpr* e) {
    for (auto& g : e->designators()) if (g.isFieldDesignator() && g.getField()) ref(g.getFieldLoc(), g.getField());
    return true;
  }
  bool TraverseConstructorInitializer(CXXCtorInitializer* i) {
    if (i->isWritten() && i->isAnyMemberInitializer()) ref(i->getMemberLocation(), i->getAnyMember());
    return Base::TraverseConstructorInitializer(i);
  }
  bool TraverseLambdaCapture(LambdaExpr* l, const LambdaCapture* c, Expr* init) {
    if (c->capturesVariable() && c->isExplicit() && !l->isInitCapture(c)) ref(c->getLocation(), cast<NamedDecl>(c->getCapturedVar()));
    return Base::TraverseLambdaCapture(l, c, init);
  }
  bool VisitLambdaExpr(LambdaExpr* l) {
    if (auto* t = l->getLambdaClass()->getDependentLambdaCallOperator())
      for (auto* s : t->specializations()) TraverseDecl(s);
    return true;
  }
  bool VisitTypeLoc(TypeLoc t) {
    if (auto x = t.getAs<TypedefTypeLoc>()) ref(x.getNameLoc(), x.getTypedefNameDecl());
    else if (auto x = t.getAs<UsingTypeLoc>()) ref(x.getNameLoc(), x.getUnderlyingType()->getAsTagDecl());
    else if (auto x = t.getAs<TagTypeLoc>()) ref(x.getNameLoc(), x.getDecl());
    else if (auto x = t.getAs<InjectedClassNameTypeLoc>()) ref(x.getNameLoc(), x.getDecl());
    else if (auto x = t.getAs<TemplateSpecializationTypeLoc>()) ref(x.getTemplateNameLoc(), x.getTypePtr()->getTemplateName().getAsTemplateDecl());
    else if (auto x = t.getAs<DeducedTemplateSpecializationTypeLoc>()) ref(x.getTemplateNameLoc(), x.getTypePtr()->getTemplateName().getAsTemplateDecl());
    return true;
  }
  bool VisitConceptSpecializationExpr(ConceptSpecializationExpr* e) { ref(e->getConceptNameLoc(), e->getNamedConcept()); return true; }
  bool VisitUsingEnumDecl(UsingEnumDecl* d) { ref(d->getEnumTypeLoc().getBeginLoc(), nullptr); return true; }

  bool lazy = false;
  // From a precompiled header only templates: what is instantiated anew.
  void top(Decl* d) {
    if (lazy && d->isFromASTFile()) {
      if (auto* n = dyn_cast<NamespaceDecl>(d)) { for (Decl* i : n->decls()) top(i); return; }
      if (isa<TemplateDecl>(d)) TraverseDecl(d);
      else if (auto* r = dyn_cast<CXXRecordDecl>(d)) { if (r->isThisDeclarationADefinition()) for (Decl* i : r->decls()) if (isa<TemplateDecl>(i) || isa<CXXRecordDecl>(i)) if (!i->isImplicit()) top(i); }
      return;
    }
    TraverseDecl(d);
  }
  std::string end(SourceLocation l) {
    l = sm.getFileLoc(l);
    return where(Lexer::getLocForEndOfToken(l, 0, sm, ctx.getLangOpts()));
  }
  // Namespace blocks and what is directly in them.
  void blocks(const DeclContext* c) {
    for (Decl* d : lazy && c->isTranslationUnit() ? llvm::SmallVector<Decl*>(c->noload_decls()) : llvm::SmallVector<Decl*>(c->decls())) {
      if (isa<LinkageSpecDecl>(d)) continue;
      auto* n = dyn_cast<NamespaceDecl>(d);
      if (!n || (lazy && n->isFromASTFile())) continue;
      std::string b = where(n->getBeginLoc());
      if (b.empty()) continue;
      // {begin of `namespace`, the brace's end, own name}
      std::string name = n->isAnonymousNamespace() ? "(anon)" : n->getQualifiedNameAsString();
      put("B\t" + b + "\t" + where(n->getRBraceLoc()) + "\t" + name + "\t" + (n->isNested() ? "nested" : "-") + "\t" + space(n));
      for (Decl* i : n->decls()) {
        if (i->isImplicit()) continue;
        std::string ib = where(i->getBeginLoc());
        if (ib.empty()) continue;
        const NamedDecl* owner = dyn_cast<NamedDecl>(i);
        bool def = true, fwd = false;
        if (auto* td = dyn_cast_or_null<TemplateDecl>(owner)) if (td->getTemplatedDecl()) owner = td->getTemplatedDecl();
        if (auto* t = dyn_cast_or_null<TagDecl>(owner)) { def = t->isThisDeclarationADefinition(); fwd = !def; }
        if (owner) {
          const DeclContext* dc = owner->getDeclContext();
          while (dc->isRecord()) { owner = cast<NamedDecl>(dc); dc = owner->getDeclContext(); }
          owner = canon(owner);
        }
        std::string ow = owner ? where(owner->getLocation()) : std::string();
        put("I\t" + ib + "\t" + end(i->getEndLoc()) + "\t" + i->getDeclKindName() + "\t" + (ow.empty() ? "-" : ow) + "\t" + (fwd ? "fwd" : "-") + "\t" + b);
      }
      blocks(n);
    }
  }
};

static bool headers = false;  // index what a precompiled header declares, too

struct Consumer : SemaConsumer {
  Sema* sema = nullptr;
  std::map<unsigned, bool> wanted;  // file -> its templates are instantiated
  void InitializeSema(Sema& s) override { sema = &s; }
  void ForgetSema() override { sema = nullptr; }
  bool HandleTopLevelDecl(DeclGroupRef) override { thin(); return true; }
  // Functions of Eigen, json, fmt, toml++ need no body here; those of the standard library call the project's lambdas.
  template <class Q> void thin(Q& q) {
    auto& sm = sema->getSourceManager();
    std::remove_reference_t<Q> kept;
    for (auto& p : q) {
      FileID f = sm.getFileID(sm.getFileLoc(p.first->getLocation()));
      auto it = wanted.find(f.getHashValue());
      if (it == wanted.end()) {
        auto name = sm.getFilename(sm.getFileLoc(p.first->getLocation()));
        bool w = !(name.contains("/eigen3/") || name.contains("/nlohmann/") || name.contains("/toml++/") || name.contains("/fmt/") || name.contains("/CLI/") || name.contains("Spectra") || name.contains("/doctest/"));
        it = wanted.emplace(f.getHashValue(), w).first;
      }
      if (it->second) kept.push_back(p);
    }
    q.swap(kept);
  }
  void thin() { if (sema) thin(sema->PendingInstantiations); }
  void HandleTranslationUnit(ASTContext& c) override {
    Visitor v(c);
    v.lazy = !headers;
    std::vector<Decl*> scope;
    for (Decl* d : headers ? llvm::SmallVector<Decl*>(c.getTranslationUnitDecl()->decls()) : llvm::SmallVector<Decl*>(c.getTranslationUnitDecl()->noload_decls()))
      if (!v.where(c.getSourceManager().getFileLoc(d->getLocation())).empty()) scope.push_back(d);
    for (Decl* d : scope) v.top(d);
    v.blocks(c.getTranslationUnitDecl());
  }
};
struct Action : ASTFrontendAction {
  std::unique_ptr<ASTConsumer> CreateASTConsumer(CompilerInstance&, StringRef) override { return std::make_unique<Consumer>(); }
};

// indexer ROOT OUT FILE -- flags
int main(int argc, char** argv) {
  headers = getenv("HEADERS") != nullptr;
  root = argv[1];
  std::string out = argv[2], file = argv[3];
  std::vector<std::string> flags(argv + 5, argv + argc);
  tooling::FixedCompilationDatabase db("/", flags);
  tooling::ClangTool tool(db, {file});
  tool.clearArgumentsAdjusters();
  tool.appendArgumentsAdjuster(tooling::getClangSyntaxOnlyAdjuster());
  int rc = tool.run(tooling::newFrontendActionFactory<Action>().get());
  std::ofstream o(out);
  for (auto& l : lines) o << l << '\n';
  return rc;
}
